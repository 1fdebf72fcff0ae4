// SPDX-License-Identifier: BSD-3-Clause
#include "config/slam_config_faults.hpp"

namespace ardrone_vslam {

std::vector<std::string> faultsBetween(const SlamConfig& config) {
  std::vector<std::string> faults;
  const HeightInputConfig& height = config.height_input;
  const MsckfConfig& filter = config.msckf;
  std::vector<std::string> heights;
  if (height.use_range) heights.emplace_back("use_range");
  if (height.use_navdata_height) heights.emplace_back("use_navdata_height");
  if (height.known_height_m > 0) heights.emplace_back("known_height_m");
  for (std::size_t i = 1; i < heights.size(); ++i)
    faults.push_back(heights[i - 1] + " and " + heights[i] +
                     " exclude each other: one height is enough");
  if (filter.height.floor_points && heights.empty())
    faults.emplace_back(
        "floor_points needs a height: set use_range and give the topic range, use_navdata_height "
        "and the topic altitude, or known_height_m");
  if (config.estimator == EstimatorKind::kMsckf) {
    if (config.planar)
      faults.emplace_back("planar needs estimator thesis (or odometry): the MSCKF has no 2-D mode");
  }
  if (config.estimator == EstimatorKind::kThesis) {
    const auto refuse = [&faults](const std::string& parameter, const std::string& without) {
      faults.push_back(parameter + " needs estimator msckf, the thesis filter would not use " +
                       "it: set estimator to msckf, or " + without);
    };
    if (height.use_range) refuse("use_range", "use_range to false");
    if (height.use_navdata_height) refuse("use_navdata_height", "use_navdata_height to false");
    if (height.known_height_m > 0) refuse("known_height_m", "known_height_m to 0");
    if (filter.height.floor_points) refuse("floor_points", "floor_points to false");
  }
  return faults;
}

}  // namespace ardrone_vslam
