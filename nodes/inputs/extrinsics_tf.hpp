// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "inputs/tf_input.hpp"

namespace ardrone_vslam {

/// Where the cameras sit on the drone, from tf. Taken as rigid: once found they are kept. And what
/// else the mapper asks of tf.
class ExtrinsicsTf {
 public:
  explicit ExtrinsicsTf(const ros::NodeHandle& nh);

  /// The latest transform, whatever its stamp: drivers stamp the extrinsics later than the image.
  /// @return T_base_cam; nothing when there is none or none that can be (extrinsicsFault): then
  /// there is a fault()
  std::optional<Eigen::Isometry3d> find(const std::string& base_frame,
                                        const std::string& camera_frame);
  /// The extrinsics cannot be asked for yet. @param fault  why
  void wait(const std::string& fault) { fault_ = fault; }
  /// What is missing and how to mend it; empty once the extrinsics are known.
  const std::string& fault() const { return fault_; }

  /// T_a_b of any two frames, as tf has it at this time, else the latest; nothing: it does not
  /// know.
  std::optional<Eigen::Isometry3d> latest(const std::string& a_frame, const std::string& b_frame,
                                          std::int64_t stamp_ns) const;

  TfBuffer& tf() { return tf_.buffer(); }
  const TfBuffer& tf() const { return tf_.buffer(); }

 private:
  TfInput tf_;
  std::string base_frame_;
  std::string fault_;
  std::map<std::string, Eigen::Isometry3d> T_base_cam_;  // by camera frame
};

}  // namespace ardrone_vslam
