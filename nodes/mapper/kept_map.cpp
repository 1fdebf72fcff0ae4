// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/kept_map.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr double kFirst_s = 10;

}  // namespace

bool KeptMap::isDue() {
  const double period_s = period_s_;
  const double wait_s = kept_ns_ == 0 ? std::min(kFirst_s, period_s) : period_s;
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (period_s == 0 || (now - tried_).toSec() < wait_s) return false;
  tried_ = now;
  return true;
}

void KeptMap::keep(MapSnapshot map) {
  const std::int64_t stamp_ns = map.all_but_landmarks.stamp_ns;
  if (stamp_ns == kept_ns_) return;
  const std::filesystem::path path(path_);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  // There may be an earlier flight's map, or this one's before it began anew.
  if (kept_ns_ == 0) {
    const std::filesystem::path before(path_ + ".before");
    if (std::filesystem::exists(path, error)) std::filesystem::remove(before, error);
    std::filesystem::create_hard_link(path, before, error);
  }
  writeMap(path_, std::move(map).map(), kMadeByMapper);
  kept_ns_ = stamp_ns;
}

}  // namespace ardrone_vslam
