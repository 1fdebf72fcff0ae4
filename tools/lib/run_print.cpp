// SPDX-License-Identifier: BSD-3-Clause
#include "run_print.hpp"

#include <iostream>
#include <string>

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(const Json& value) {
  return value.is_null() ? "-" : value.dump();
}

}  // namespace

void printSummary(const Json& summary) {
  for (const auto& item : summary.items()) {
    if (!item.value().is_object()) std::cout << item.key() << ": " << shown(item.value()) << '\n';
  }
  std::cout << "stage_share:";
  for (const auto& stage : summary["stage_share"].items())
    std::cout << ' ' << stage.key() << ' ' << shown(stage.value());
  std::cout << '\n';
}

void printSeeds(const Json& summary) {
  std::cout << "seed, observer_ate_rmse_m, fused_ate_rmse_m, ratio, ratio_scale_removed\n";
  for (const Json& run : summary["runs"]) {
    std::cout << shown(run["seed"]);
    for (const char* name :
         {"observer_ate_rmse_m", "fused_ate_rmse_m", "ratio", "ratio_scale_removed"}) {
      std::cout << ", " << shown(run[name]);
    }
    std::cout << '\n';
  }
  for (const char* kind : {"median", "worst"})
    std::cout << kind << ": " << summary[kind].dump() << '\n';
}

}  // namespace ardrone_vslam
