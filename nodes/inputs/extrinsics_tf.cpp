// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/extrinsics_tf.hpp"

#include <tf2/exceptions.h>

#include "ardrone_vslam/slam.hpp"
#include "conversions/conversions.hpp"

namespace ardrone_vslam {

ExtrinsicsTf::ExtrinsicsTf(const ros::NodeHandle& nh) : tf_(nh) {}

std::optional<Eigen::Isometry3d> ExtrinsicsTf::find(const std::string& base_frame,
                                                    const std::string& camera_frame) {
  fault_.clear();
  if (base_frame != base_frame_) T_base_cam_.clear();
  base_frame_ = base_frame;
  const auto known = T_base_cam_.find(camera_frame);
  if (known != T_base_cam_.end()) return known->second;
  try {
    const auto T_base_cam = toIsometry(
        tf_.buffer().core().lookupTransform(base_frame, camera_frame, ros::Time(0)).transform);
    const std::string wrong =
        T_base_cam.value ? extrinsicsFault(*T_base_cam.value) : T_base_cam.fault;
    if (wrong.empty()) return T_base_cam_[camera_frame] = *T_base_cam.value;
    fault_ = "transform from " + base_frame + " to " + camera_frame + ": " + wrong;
  } catch (const tf2::TransformException& e) {
    fault_ = "no transform from " + base_frame + " to " + camera_frame + " (" + e.what() +
             "): publish the camera's mounting, for example by `rosrun tf2_ros "
             "static_transform_publisher x y z -1.5708 0 -1.5708 " +
             base_frame + " " + camera_frame +
             "` (x y z: where it is [m]; these angles look ahead, docs/any_robot.md has others)";
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> ExtrinsicsTf::latest(const std::string& a_frame,
                                                      const std::string& b_frame,
                                                      std::int64_t stamp_ns) const {
  const tf2::BufferCore& tf = tf_.buffer().core();
  for (const ros::Time& time : {toRosTime(stamp_ns), ros::Time(0)}) {
    if (!tf.canTransform(a_frame, b_frame, time)) continue;
    try {
      return toIsometry(tf.lookupTransform(a_frame, b_frame, time).transform).value;
    } catch (const tf2::TransformException&) {  // forgotten meanwhile
    }
  }
  return std::nullopt;
}

}  // namespace ardrone_vslam
