// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// Of what moves, base or a camera, in the frame of its trajectory: map, or odom of an odometry.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_frame_body = Eigen::Isometry3d::Identity();
};

/// No robot's map reaches further; what does is a fault of its source, and squares of it leave a
/// double's range.
constexpr double kFarthest_m = 1e7;
constexpr const char* kTooFarFault = "the position is more than 1e7 m from the origin";

inline bool isTooFar(const Eigen::Vector3d& position) {
  return position.cwiseAbs().maxCoeff() > kFarthest_m;
}

/// Poses with ascending stamps. Interpolation: position linearly, orientation by slerp.
class Trajectory {
 public:
  Trajectory() = default;
  /// @throws std::invalid_argument when the stamps do not ascend strictly or a pose is not finite
  explicit Trajectory(const std::vector<StampedPose>& poses);

  const std::vector<StampedPose>& poses() const { return poses_; }
  bool empty() const { return poses_.empty(); }
  std::size_t size() const { return poses_.size(); }
  /// Pose at a stamp; the first or last pose outside the covered time. @pre not empty
  Eigen::Isometry3d at(std::int64_t stamp_ns) const;
  /// @throws std::invalid_argument as the constructor
  /// Whether `at` interpolates between poses at most `max_gap_ns` apart, rather than repeats the
  /// first or last one.
  bool covers(std::int64_t stamp_ns, std::int64_t max_gap_ns) const;
  void append(const StampedPose& pose);

 private:
  std::vector<StampedPose> poses_;
};

/// TUM format, a line each: stamp[s] tx ty tz[m] qx qy qz qw. '#' begins a comment.
/// @throws std::runtime_error naming file, line and fault
Trajectory readTum(const std::string& path);
/// The same, but stamps may repeat or go back, as a faulty odometry's do.
std::vector<StampedPose> readTumPoses(const std::string& path);
/// Nine decimals for stamps and positions. @throws std::runtime_error when the file cannot be
/// written
void writeTum(const std::string& path, const Trajectory& trajectory);
/// The same for stamps in any order; each line of `comment` goes to the file's head behind a '#'.
void writeTumPoses(const std::string& path, const std::vector<StampedPose>& poses,
                   const std::string& comment);

}  // namespace ardrone_vslam
