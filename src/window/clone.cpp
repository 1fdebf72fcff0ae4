// SPDX-License-Identifier: BSD-3-Clause
#include "window/clone.hpp"

#include <algorithm>

#include "linear/scalars.hpp"

namespace ardrone_vslam {

std::optional<std::size_t> indexOf(const std::vector<Clone>& poses, std::uint32_t id) {
  const auto found =
      std::find_if(poses.begin(), poses.end(), [id](const Clone& pose) { return pose.id == id; });
  if (found == poses.end()) return std::nullopt;
  return static_cast<std::size_t>(found - poses.begin());
}

std::uint32_t FrameIds::take(const std::vector<Clone>& anchors, const std::vector<Clone>& frames) {
  std::uint32_t id = 0;
  do {
    id = next_++;
  } while (id == 0 || indexOf(anchors, id) || indexOf(frames, id));
  return id;
}

Eigen::Vector3d recentVelocity_base_m_s(const std::vector<Clone>& frames,
                                        const Eigen::Matrix3d& R_base_rig) {
  constexpr double kSpan_s = 2;  // steps of single frames are noisy
  Eigen::Vector3d displacement_base_m = Eigen::Vector3d::Zero();
  double passed_s = 0;
  for (std::size_t i = frames.size() - 1; i-- > 0 && passed_s < kSpan_s;) {
    displacement_base_m += R_base_rig * frames[i].R_map_rig.transpose() *
                           (frames[i + 1].position_map - frames[i].position_map);
    passed_s = seconds(frames.back().stamp_ns - frames[i].stamp_ns);
  }
  return passed_s > 0 ? Eigen::Vector3d(displacement_base_m / passed_s) : Eigen::Vector3d::Zero();
}

}  // namespace ardrone_vslam
