// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_print.hpp"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

/// What a run, or one of several, does not have is a dash.
void printRow(const std::string& name, const Json& numbers, std::ostream& out) {
  out << std::setw(6) << name;
  const auto cell = [&](const char* key, int width, int digits) {
    std::ostringstream text;
    if (numbers.contains(key) && numbers[key].is_number()) {
      text << std::fixed << std::setprecision(digits) << numbers[key].get<double>();
    } else {
      text << '-';
    }
    out << std::setw(width) << text.str();
  };
  cell("odometry_ate_rmse_m", 19, 4);
  cell("fused_ate_rmse_m", 16, 4);
  cell("ratio", 7, 3);
  cell("ratio_scale_removed", 21, 3);
  out << '\n';
}

}  // namespace

void printSeeds(const Json& summary, std::ostream& out) {
  out << "  seed  odometry RMSE [m]  fused RMSE [m]  ratio  ratio_scale_removed\n";
  for (const Json& run : summary["runs"]) printRow(run["seed"].dump(), run, out);
  for (const char* kind : {"median", "worst"})
    printRow(kind, summary.value(kind, Json::object()), out);
  const int dropped = summary["runs"].front().value("frames_dropped_slow", 0);
  if (dropped > 0)
    out << "frames: " << summary["frames"] << ", and " << dropped << " dropped as too slow\n";
}

}  // namespace ardrone_vslam
