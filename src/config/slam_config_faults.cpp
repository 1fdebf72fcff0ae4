// SPDX-License-Identifier: BSD-3-Clause
#include "config/slam_config_faults.hpp"

namespace ardrone_vslam {
namespace {

/// A parameter that is set, and the value that switches it off.
struct Setting {
  std::string name;
  std::string off;
};

std::vector<Setting> heightsOf(const HeightInputConfig& config) {
  std::vector<Setting> heights;
  if (config.use_range) heights.push_back({"use_range", "false"});
  if (config.use_navdata_height) heights.push_back({"use_navdata_height", "false"});
  if (config.known_height_m > 0) heights.push_back({"known_height_m", "0"});
  return heights;
}

}  // namespace

std::string faultOfMaps(const SlamConfig& config, std::size_t landmarks) {
  if (config.estimator != EstimatorKind::kMsckf)
    return "maps are loaded and saved with estimator msckf alone: set estimator to msckf";
  const auto most = static_cast<std::size_t>(config.landmark_map.most());
  if (landmarks <= most) return {};
  return "the map has " + std::to_string(landmarks) +
         " landmarks, and max_landmarks (or max_map_mb) allows " + std::to_string(most) +
         ": set it higher, or make the map smaller by map_tool prune --most";
}

std::vector<std::string> faultsBetween(const SlamConfig& config) {
  std::vector<std::string> faults;
  std::vector<Setting> heights = heightsOf(config.height_input);
  for (std::size_t i = 1; i < heights.size(); ++i)
    faults.push_back(heights[i - 1].name + " and " + heights[i].name +
                     " exclude each other: one height is enough");
  const bool floor_points = config.msckf.height.floor_points;
  if (floor_points && heights.empty())
    faults.emplace_back(
        "floor_points needs a height: set use_range and give the topic range, use_navdata_height "
        "and the topic altitude, or known_height_m");
  if (config.estimator == EstimatorKind::kMsckf && config.planar && !heights.empty())
    faults.push_back("planar and " + heights.front().name +
                     " exclude each other, as planar says that the height is constant: set planar "
                     "to false, or " +
                     heights.front().name + " to " + heights.front().off);
  if (config.estimator != EstimatorKind::kThesis) return faults;
  if (floor_points) heights.push_back({"floor_points", "false"});
  for (const Setting& unused : heights)
    faults.push_back(unused.name +
                     " needs estimator msckf, the thesis filter would not use it: set estimator "
                     "to msckf, or " +
                     unused.name + " to " + unused.off);
  return faults;
}

}  // namespace ardrone_vslam
