// SPDX-License-Identifier: BSD-3-Clause
#include "summary/seeds_summary.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "trajectory/metrics.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

// A number that is added to the summary, and of which more is better or says nothing, belongs here.
bool isWorseWhenLarger(const std::string& key) {
  for (const char* name :
       {"seed", "tracks_aligned_share", "landmark_matches_median", "landmarks", "heights_used",
        "camera_frames", "frames_per_second", "odometry_scale_error", "velocity_bias_learned_m_s",
        "yaw_walk_learned_over_configured", "image_time_offset_s", "image_time_offset_estimate_s",
        "refined_keyframes", "refined_points", "refined_views"}) {
    if (key == name) return false;
  }
  return true;
}

}  // namespace

Json summaryOfSeeds(const std::vector<Json>& summaries) {
  Json result;
  for (const char* name : {"sequence", "frames", "profile", "estimator"})
    result[name] = summaries.front()[name];
  Json seeds = Json::array();
  for (const Json& summary : summaries) seeds.push_back(summary["seed"]);
  result["seeds"] = seeds;
  for (const auto& item : summaries.front().items()) {
    if (result.contains(item.key()) || !isWorseWhenLarger(item.key())) continue;
    std::vector<double> values;
    for (const Json& summary : summaries) {
      if (summary[item.key()].is_number()) values.push_back(summary[item.key()].get<double>());
    }
    if (values.size() != summaries.size()) continue;
    result["median"][item.key()] = quantile(values, 0.5);
    result["worst"][item.key()] = quantile(values, 1.0);
  }
  result["runs"] = summaries;
  return result;
}

}  // namespace ardrone_vslam
