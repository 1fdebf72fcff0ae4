// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/estimator.hpp"

#include <cassert>
#include <utility>

namespace ardrone_vslam {

void Estimator::enterMap(MapEntry&& /*entry*/, SavedMap&& /*loaded*/, const FrameView& /*view*/,
                         LandmarkMap& /*map*/) {
  assert(false && "this estimator keeps no anchors");
}

bool Estimator::shift(const Revisit& /*revisit*/, const FrameView& /*view*/, LandmarkMap& /*map*/) {
  assert(false && "this estimator keeps no anchors");
  return false;
}

MapSnapshot Estimator::save(const LandmarkMap& /*map*/) const {
  assert(false && "this estimator keeps no anchors");
  return {};
}

void moveTo(CameraPose camera, FrameView& view) {
  view.setOrigin(camera.T_map_cam.translation());
  view.setPositionVariance(camera.position_variance_m2, camera.common_drift);
  view.setDrifts(std::move(camera.drifts));
}

}  // namespace ardrone_vslam
