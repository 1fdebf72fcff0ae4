// SPDX-License-Identifier: BSD-3-Clause
#include "summary/map_summary.hpp"

#include <nlohmann/json.hpp>

namespace ardrone_vslam {
namespace {

bool isFound(const RunResult& run, std::size_t found_frame) {
  return run.is_in_loaded_map && found_frame < run.frames.size();
}

}  // namespace

Eigen::Isometry3d odometryFrameWhenFound(const RunResult& run, std::size_t found_frame) {
  if (!isFound(run, found_frame)) return Eigen::Isometry3d::Identity();
  const FrameResult& found = run.frames[found_frame].result;
  return found.T_map_base * found.T_odom_base.inverse();
}

void addMap(const RunResult& run, std::size_t found_frame, nlohmann::ordered_json& summary) {
  summary["frames_searching_map"] = found_frame;
  summary["map_found_s"] = nullptr;
  if (!isFound(run, found_frame)) return;
  const std::int64_t searched_ns =
      run.frames[found_frame].result.stamp_ns - run.frames.front().result.stamp_ns;
  summary["map_found_s"] = static_cast<double>(searched_ns) / 1e9;  // 5.3 and not 5.300000000000001
}

}  // namespace ardrone_vslam
