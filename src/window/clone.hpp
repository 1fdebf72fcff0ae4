// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace ardrone_vslam {

/// A pose of base that the filter estimates: a frame of the window, or an anchor of landmarks.
struct Clone {
  std::uint32_t id = 0;  ///< ascending until all were used, not that of another pose here; of a
                         ///< loaded map's from the largest number downwards
  std::int64_t stamp_ns = 0;                                ///< of the image
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();   ///< of base
  Eigen::Matrix3d R_map_rig = Eigen::Matrix3d::Identity();  ///< of the rig, which is base but for
                                                            ///< the extrinsics' error (WindowState)
  /// By what share an error of the odometry's velocity, axes of base, stretches the way here: the
  /// velocity over its square. What is seen from here shares it.
  Eigen::Vector3d stretch_by_bias_s_m = Eigen::Vector3d::Zero();
  std::optional<double> height_m;  ///< above the floor, measured
  double stretch = 1;              ///< by corrections of scale and bias, of what belongs to it
  bool is_loaded = false;  ///< of an earlier flight: this one's scale and bias did not make it
};

/// Place of the pose of this id among them; nothing when there is none. O(poses).
std::optional<std::size_t> indexOf(const std::vector<Clone>& poses, std::uint32_t id);

/// Clone::id of each new frame: they count up, and begin anew after years of flight.
class FrameIds {
 public:
  explicit FrameIds(std::uint32_t first) : next_(first) {}
  /// An id that none of these poses has, nor 0, which stands for none. O(poses).
  std::uint32_t take(const std::vector<Clone>& anchors, const std::vector<Clone>& frames);

 private:
  std::uint32_t next_;
};

/// Of base, over the last two seconds of the window's frames, axes of base at the newest; zero of
/// one frame. The odometry's own velocity would jitter, and its bias, which counts as across the
/// way or along it, would seem to be seen. O(frames).
Eigen::Vector3d recentVelocity_base_m_s(const std::vector<Clone>& frames,
                                        const Eigen::Matrix3d& R_base_rig);

}  // namespace ardrone_vslam
