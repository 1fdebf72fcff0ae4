// SPDX-License-Identifier: BSD-3-Clause
// map_drawing: what it costs the mapper, twice a second, to tell rviz what of a large map looks
// otherwise: while it is sent for the first time, and when nothing has changed.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <vector>

#include "conversions/markers.hpp"
#include "program/tool_main.hpp"
#include "simulation/random_source.hpp"
#include "thread_time.hpp"

namespace {

using namespace ardrone_vslam;

constexpr double kWide_m = 100;

Landmarks mapOf(std::uint32_t count) {
  RandomSource random(1, 1);
  std::vector<Landmark> map(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    map[i].id = i + 1;
    map[i].position_map =
        kWide_m * Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform());
    map[i].sigma_m = 0.05F;
  }
  return map;
}

void measure(std::uint32_t count) {
  const Landmarks map = mapOf(count);
  LandmarkMarkers markers;
  const std::size_t calls =
      1 + (count - 1) / (LandmarkMarkers::kBlock * LandmarkMarkers::kMostBlocks);
  std::vector<double> times_ms[2];
  for (std::vector<double>& times : times_ms)
    for (std::size_t i = 0; i < calls; ++i) {
      const double begin_ns = bench::threadTime_ns();
      markers.changes(map, {}, Eigen::Vector3d::Zero());
      times.push_back((bench::threadTime_ns() - begin_ns) / 1e6);
    }
  const auto [least, most] = std::minmax_element(times_ms[0].begin(), times_ms[0].end());
  std::printf("| %u | %zu | %.1f to %.1f | %.1f |\n", count, calls, *least, *most,
              *std::max_element(times_ms[1].begin(), times_ms[1].end()));
}

int run() {
  std::printf(
      "| landmarks | sent in parts | each, the first time [ms] | nothing new, at most [ms] |\n"
      "|---|---|---|---|\n");
  for (const std::uint32_t count : {1'000U, 10'000U, 100'000U}) measure(count);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures what drawing a map costs the mapper.", "map_drawing"};
  return runTool(app, argc, argv, run);
}
