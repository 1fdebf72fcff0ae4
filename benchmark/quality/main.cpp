// SPDX-License-Identifier: BSD-3-Clause
// Measures how well features repeat and match.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/core.hpp>

#include "frames.hpp"
#include "graf.hpp"
#include "motions.hpp"
#include "program/tool_main.hpp"
#include "report.hpp"
#include "source_images.hpp"
#include "sweeps.hpp"

namespace {

using namespace ardrone_vslam;
using namespace ardrone_vslam::quality;

constexpr int kBudget = 500;
constexpr int kFrames = 300, kQuickFrames = 12;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) {
    throw std::runtime_error("cannot write " + path.string() +
                             "; give --out a folder that can be written to");
  }
  std::cout << "wrote " << path.string() << '\n';
}

QualityResults measure(bool quick) {
  QualityResults results;
  results.budget = kBudget;
  results.motion_frames = quick ? kQuickFrames : kFrames;
  const SourceImages source = sweepImages(quick);
  results.sweep_images = source.what;
  std::cout << "sweeps over " << source.what << " ..." << std::endl;
  results.sweeps = runSweeps(source, kBudget, quick);
  if (const auto folder = bench::dataFolder()) {
    std::cout << "graf ..." << std::endl;
    results.graf.push_back(runGraf(*folder + "/graf", kBudget));
  } else {
    std::cout << "graf is left out: ARDRONE_VSLAM_DATA names no folder that has it" << std::endl;
  }
  std::cout << "four motions ..." << std::endl;
  auto charts = runMotions(results.motion_frames, kBudget);
  results.motions = std::move(charts.motions);
  results.passes = std::move(charts.passes);
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Repeatability and matching quality of FAST with FREAK beside ORB, BRISK and AKAZE",
               "front_end_quality");
  std::string out;
  bool quick = false;
  app.add_option("--out", out, "folder for quality.json and quality.md")->required();
  app.add_flag("--quick", quick, "one picture, fewer steps and frames: a rough look");
  return runTool(app, argc, argv, [&] {
    std::filesystem::create_directories(out);
    const QualityResults results = measure(quick);
    write(std::filesystem::path(out) / "quality.json", toJson(results));
    write(std::filesystem::path(out) / "quality.md", toMarkdown(results));
    return 0;
  });
}
