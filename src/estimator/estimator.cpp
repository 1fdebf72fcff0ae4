// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/estimator.hpp"

#include <utility>

namespace ardrone_vslam {

void moveTo(CameraPose camera, FrameView& view) {
  view.setOrigin(camera.T_map_cam.translation());
  view.setPositionVariance(camera.position_variance_m2, camera.common_drift);
  view.setDrifts(std::move(camera.drifts));
}

}  // namespace ardrone_vslam
