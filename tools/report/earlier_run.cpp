// SPDX-License-Identifier: BSD-3-Clause
#include "report/earlier_run.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "files/regular_file.hpp"
#include "report/run_files.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

Json readSummary(const std::string& folder) {
  const std::string path = folder + "/summary.json";
  if (!faultOfFile(path, kLargestTable_bytes).empty()) return {};
  std::ifstream file(path);
  constexpr bool kThrows = false;
  return file ? Json::parse(file, nullptr, kThrows) : Json();
}

/// Another program's file may have the same name; that of a recording, which cannot be made again,
/// does not say which estimator ran.
bool isOurs(const Json& summary) {
  return summary.is_object() && summary.contains("sequence") && summary.contains("frames") &&
         summary.contains("estimator") && summary.contains("profile") &&
         (summary.contains("runs") || summary.contains("fused_ate_rmse_m"));
}

void removeFiles(const std::string& folder) {
  std::error_code ignored;  // what cannot be removed cannot be overwritten, which is told then
  for (const char* name : kRunFiles) {
    std::filesystem::remove(folder + "/" + name, ignored);
    std::filesystem::remove(folder + "/" + name + ".part", ignored);  // of a run that was killed
  }
  for (const char* name : kPageFiles) std::filesystem::remove(folder + "/" + name, ignored);
}

}  // namespace

void removeEarlierRun(const std::string& folder) {
  const Json summary = readSummary(folder);
  if (!isOurs(summary)) return;
  for (const Json& seed : summary.value("seeds", Json::array())) {
    if (!seed.is_number_unsigned()) continue;
    const std::string seed_folder = seedFolder(folder, seed.get<std::uint64_t>());
    if (std::filesystem::is_symlink(seed_folder) || !isOurs(readSummary(seed_folder))) continue;
    removeFiles(seed_folder);
    std::error_code is_not_empty;
    std::filesystem::remove(seed_folder, is_not_empty);
  }
  removeFiles(folder);
}

}  // namespace ardrone_vslam
