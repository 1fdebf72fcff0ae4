// SPDX-License-Identifier: BSD-3-Clause
// thesis_measurements: repeats the thesis's measurements that need no flight, one JSON file each.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

#include "measurements.hpp"
#include "program/tool_main.hpp"

namespace {

using namespace ardrone_vslam;
using namespace ardrone_vslam::reproduction;

const std::map<std::string, nlohmann::json (*)(bool quick)>& sections() {
  static const std::map<std::string, nlohmann::json (*)(bool quick)> all = {
      {"detectors", measureDetectors},
      {"repeatability", measureRepeatability},
      {"corner_speed", measureCornerSpeed},
      {"sampling", measureSampling},
      {"descriptors", measureDescriptors},
      {"matches", measureMatches},
      {"quality", measureQuality},
      {"lens", measureLens},
      {"mean_deviation", measureMeanDeviation},
      {"landmark_sigma", measureLandmarkDeviation},
  };
  return all;
}

void write(const std::filesystem::path& path, const nlohmann::json& json) {
  std::ofstream file(path);
  file << json.dump(1) << '\n';
  file.close();
  if (!file)
    throw std::runtime_error("cannot write " + path.string() +
                             "; give --out a folder that can be written to");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Repeats measurements of the thesis that need no flight; scripts/reproduce makes a page of "
      "them",
      "thesis_measurements");
  std::vector<std::string> names;
  std::string out;
  bool quick = false;
  app.add_option("section", names, "which; default: all")->check(CLI::IsMember(sections()));
  app.add_option("--out", out, "folder for SECTION.json")->required();
  app.add_flag("--quick", quick, "fewer pictures, frames and repetitions");
  return runTool(app, argc, argv, [&] {
    if (names.empty())
      for (const auto& section : sections()) names.push_back(section.first);
    std::filesystem::create_directories(out);
    for (const std::string& name : names) {
      std::cout << name << " ..." << std::endl;
      write(std::filesystem::path(out) / (name + ".json"), sections().at(name)(quick));
    }
    return 0;
  });
}
