// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "report.hpp"

namespace ardrone_vslam::quality {
namespace {

/// Steps of a sweep that the page shows; the plots show all.
const std::vector<double> kShownSteps = {0.5, 0.7, 0.8, 1, 1.25, 1.6, 2, 3, 4, 30, 45, 90, 180};
constexpr int kFewFeatures = 50;                     // fewer are named: their shares say little
constexpr std::size_t kOneApart = 0, kTenApart = 1;  // in the motions' charts

std::string percent(double share) {
  return std::to_string(std::lround(100 * share));
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string cell(const PairMetrics& m) {
  const std::string few =
      m.features < kFewFeatures ? " (" + std::to_string(m.features) + " features)" : "";
  return percent(m.repeatability) + " / " + percent(m.matching_score) + " / " +
         percent(m.precision) + few;
}

void writeRow(std::ostream& page, const std::vector<std::string>& cells) {
  for (const auto& text : cells) page << "| " << text << " ";
  page << "|\n";
}

void writeHead(std::ostream& page, const std::vector<std::string>& cells) {
  writeRow(page, cells);
  for (std::size_t i = 0; i < cells.size(); ++i) page << "|---";
  page << "|\n";
}

/// @param shown  indices into the chart's x
void writeChart(std::ostream& page, const Chart& chart, const std::string& prefix,
                const std::vector<std::size_t>& shown) {
  std::vector<std::string> cells = {chart.axis};
  for (const std::size_t i : shown) cells.push_back(prefix + number(chart.x[i]));
  writeHead(page, cells);
  for (const auto& curve : chart.curves) {
    cells = {curve.method};
    for (const std::size_t i : shown) cells.push_back(cell(curve.points[i]));
    writeRow(page, cells);
  }
  page << "\n";
}

/// Without the step that compares a picture with itself.
std::vector<std::size_t> shownSteps(const Chart& chart) {
  const double neutral = chart.name == "scale" ? 1 : 0;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < chart.x.size(); ++i) {
    const bool is_listed = std::count(kShownSteps.begin(), kShownSteps.end(), chart.x[i]) > 0;
    if (is_listed && chart.x[i] != neutral) shown.push_back(i);
  }
  return shown;
}

void writeIntroduction(std::ostream& page, const QualityResults& results) {
  page << "## Repeatability and matching quality\n\n"
       << "The same budget for all: the " << results.budget
       << " strongest features of an image, at least " << kBorder_px
       << " px inside its border. FAST + FREAK is this package's, in one cell and with a fixed "
          "threshold of 8, so that the strongest of the whole image are kept. ORB (8 levels, FAST "
          "threshold 8), BRISK (threshold 15) and AKAZE (M-LDB, threshold 0.0001) are OpenCV's, "
          "else with their defaults. All descriptors are matched alike: exact nearest neighbour, "
          "the matcher's default ratio test and cross check, no motion prior. The distance has no "
          "limit, as its scale differs from descriptor to descriptor. *Roll known*: FREAK is told "
          "by how much the scene is turned and leaves its 45 orientation pairs out.\n\n"
       << "Cells are **repeatability / matching score / precision** in %:\n"
       << "- repeatability: points found in both images / features, in the region that both "
          "images show, of the image with fewer (Mikolajczyk et al. 2005);\n"
       << "- matching score: correct matches / the same number of features;\n"
       << "- precision: correct matches / matches.\n\n"
       << "Two features are the same point when the true geometry brings one within "
       << kSamePoint_px << " px of the other, in the coarser of the two images.\n\n";
}

void writeSweeps(std::ostream& page, const QualityResults& results) {
  page << "### Turned, scaled, blurred (thesis figures 4.5-4.7)\n\n"
       << "Means over " << results.sweep_images
       << "; each picture against itself changed. The thesis took its figures from a table on the "
          "web that states neither images nor criterion, so curves compare in shape only. FAST + "
          "FREAK has one scale, the peers have pyramids. Features of cv::ORB's coarse levels are "
          "reported (s - 1) / 2 px off, s being the level's scale. So its two coarsest levels miss "
          "the 2 px of the criterion when turned by 180 degrees. They meet it when that is "
          "added.\n\n";
  for (const auto& chart : results.sweeps) writeChart(page, chart, "", shownSteps(chart));
  page << "![quality when turned, scaled and blurred](plots/quality_sweeps.png)\n\n";
}

void writeGraf(std::ostream& page, const QualityResults& results) {
  page << "### graf: a painted wall from 20 to 60 degrees aside\n\n";
  if (results.graf.empty()) {
    page << "Left out: ARDRONE_VSLAM_DATA names no folder that has it.\n\n";
    return;
  }
  for (const auto& chart : results.graf) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < chart.x.size(); ++i) shown.push_back(i);
    writeChart(page, chart, "1-", shown);
  }
  page << "![quality on graf](plots/quality_graf.png)\n\n";
}

void writeMotionTable(std::ostream& page, const std::vector<Chart>& motions, std::size_t gap) {
  std::vector<std::string> cells = {number(motions.front().x[gap]) + " frames apart"};
  if (motions.front().x[gap] == 1) cells[0] = "1 frame apart";
  for (const auto& chart : motions) cells.push_back(chart.name);
  writeHead(page, cells);
  for (std::size_t k = 0; k < motions.front().curves.size(); ++k) {
    cells = {motions.front().curves[k].method};
    for (const auto& chart : motions) cells.push_back(cell(chart.curves[k].points[gap]));
    writeRow(page, cells);
  }
  page << "\n";
}

void writeMotions(std::ostream& page, const QualityResults& results) {
  page << "### Four motions\n\n"
       << "Rendered flights through the synthetic room, " << results.motion_frames
       << " frames each, 568x320, 30 a second, with the AR.Drone's lens. The noise is 2 grey "
          "levels, without motion blur. They are a circle and sideways across the viewing "
          "direction, to and fro along it, and a turn on the spot (36 degrees a second).\n\n";
  writeMotionTable(page, results.motions, kOneApart);
  writeMotionTable(page, results.motions, kTenApart);
}

/// Shares of what 16 passes give.
std::string passesCell(const PairMetrics& m, const PairMetrics& all) {
  const auto share = [](int part, int whole) {
    return percent(whole > 0 ? static_cast<double>(part) / whole : 0);
  };
  return share(m.features, all.features) + " / " + share(m.correct, all.correct) + " / " +
         percent(m.precision);
}

void writePasses(std::ostream& page, const QualityResults& results) {
  page << "### Matches against sampling passes (thesis figure 4.9)\n\n"
       << "The same flights, one frame apart, threshold 35, every corner found (no budget). Cells: "
          "**corners / correct matches**, both in % of those with 16 passes, **/ precision** in "
          "%.\n\n";
  const Chart& first = results.passes.front();
  std::vector<std::string> cells = {"motion", first.axis};
  for (const double passes : first.x) cells.push_back(number(passes));
  cells.emplace_back("correct with 16");
  writeHead(page, cells);
  for (const auto& chart : results.passes) {
    for (const auto& curve : chart.curves) {
      const PairMetrics& all = curve.points.back();
      cells = {chart.name, curve.method};
      for (const auto& point : curve.points) cells.push_back(passesCell(point, all));
      cells.push_back(std::to_string(all.correct));
      writeRow(page, cells);
    }
  }
  page << "\n![matches against sampling passes](plots/quality_passes.png)\n";
}

}  // namespace

std::string toMarkdown(const QualityResults& results) {
  std::ostringstream page;
  writeIntroduction(page, results);
  writeSweeps(page, results);
  writeGraf(page, results);
  writeMotions(page, results);
  writePasses(page, results);
  return page.str();
}

}  // namespace ardrone_vslam::quality
