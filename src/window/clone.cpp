// SPDX-License-Identifier: BSD-3-Clause
#include "window/clone.hpp"

#include <algorithm>

namespace ardrone_vslam {

std::optional<std::size_t> indexOf(const std::vector<Clone>& poses, std::uint32_t id) {
  const auto found =
      std::find_if(poses.begin(), poses.end(), [id](const Clone& pose) { return pose.id == id; });
  if (found == poses.end()) return std::nullopt;
  return static_cast<std::size_t>(found - poses.begin());
}

}  // namespace ardrone_vslam
