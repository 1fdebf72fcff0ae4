// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/fusion_frames.hpp"

#include <utility>

#include "conversions/frame_names.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

FusionFrames::FusionFrames(const OdometryFusionNodeConfig& config, std::string tf_prefix)
    : tf_prefix_(std::move(tf_prefix)), base_frame_(config.base_frame) {
  frames_.map = withTfPrefix(tf_prefix_, config.map_frame);
}

void FusionFrames::see(const std::string& odometry_child) {
  frames_.base = withTfPrefix(tf_prefix_, base_frame_.empty() ? odometry_child : base_frame_);
}

std::string FusionFrames::faultOf(const PoseCorrection& correction) const {
  if (correction.header.frame_id != frames_.map) {
    return text("it is in the frame '", correction.header.frame_id, "', not in '", frames_.map,
                "'; set map_frame and tf_prefix as the mapper's");
  }
  if (!frames_.base.empty() && correction.child_frame_id != frames_.base) {
    return text("it is of '", correction.child_frame_id, "', the odometry of '", frames_.base,
                "'; remap odometry to the mapper's topic, or set base_frame as the mapper's");
  }
  return {};
}

}  // namespace ardrone_vslam
