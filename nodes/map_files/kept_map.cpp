// SPDX-License-Identifier: BSD-3-Clause
#include "map_files/kept_map.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "files/set_aside.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kFirst_s = 10;

}  // namespace

bool KeptMap::isDue() {
  const double period_s = period_s_;
  const double wait_s = kept_number_ != number_ ? std::min(kFirst_s, period_s) : period_s;
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (period_s == 0 || (now - tried_).toSec() < wait_s) return false;
  tried_ = now;
  return true;
}

void KeptMap::keep(MapSnapshot map, int number) {
  const std::int64_t stamp_ns = map.all_but_landmarks.stamp_ns;
  if (number == kept_number_ && stamp_ns == kept_ns_) return;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), error);
  const std::string fault = number == kept_number_ ? "" : setAside(path_);
  if (!fault.empty()) throw MapFileError(fault);
  writeMap(path_, std::move(map).map(), made_by_);
  kept_number_ = number;
  kept_ns_ = stamp_ns;
}

}  // namespace ardrone_vslam
