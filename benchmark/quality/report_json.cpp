// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "report.hpp"

namespace ardrone_vslam::quality {
namespace {

nlohmann::json curveJson(const Curve& curve) {
  nlohmann::json json;
  for (const auto& point : curve.points) {
    json["features"].push_back(point.features);
    json["matches"].push_back(point.matches);
    json["correct"].push_back(point.correct);
    json["repeatability"].push_back(point.repeatability);
    json["matching_score"].push_back(point.matching_score);
    json["precision"].push_back(point.precision);
  }
  return json;
}

nlohmann::json chartsJson(const std::vector<Chart>& charts) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& chart : charts) {
    nlohmann::json curves = nlohmann::json::array();
    for (const auto& curve : chart.curves) {
      nlohmann::json json = curveJson(curve);
      json["method"] = curve.method;
      curves.push_back(json);
    }
    all.push_back({{"name", chart.name}, {"axis", chart.axis}, {"x", chart.x}, {"curves", curves}});
  }
  return all;
}

}  // namespace

std::string toJson(const QualityResults& results) {
  const nlohmann::json json = {{"budget", results.budget},
                               {"sweep_images", results.sweep_images},
                               {"motion_frames", results.motion_frames},
                               {"same_point_px", kSamePoint_px},
                               {"border_px", kBorder_px},
                               {"sweeps", chartsJson(results.sweeps)},
                               {"graf", chartsJson(results.graf)},
                               {"motions", chartsJson(results.motions)},
                               {"passes", chartsJson(results.passes)}};
  return json.dump(1) + "\n";
}

}  // namespace ardrone_vslam::quality
