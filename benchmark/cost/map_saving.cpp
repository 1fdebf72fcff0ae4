// SPDX-License-Identifier: BSD-3-Clause
// map_saving: what it costs the mapper that a large map is saved while it runs, and how long the
// map takes to write and to read. Synthetic, as in mapping_cost: a street that is driven twice, the
// second time in its map, to which landmarks far away have been added.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <stdexcept>
#include <thread>

#include "ardrone_vslam/saved_map.hpp"
#include "ardrone_vslam/slam.hpp"
#include "program/tool_main.hpp"
#include "sequences/sequence.hpp"
#include "simulation/random_source.hpp"
#include "street_scene.hpp"
#include "trajectory/metrics.hpp"

namespace {

using namespace ardrone_vslam;
using Clock = std::chrono::steady_clock;

constexpr int kFeatures = 200;
constexpr int kFrames = 400;
constexpr std::chrono::milliseconds kPeriod(33);

double since_ms(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The street's own map, and landmarks that belong to it, but lie more than a kilometre away.
SavedMap largeMap(const Scene& scene, std::size_t landmarks) {
  const std::vector<OdometryState> odometry = truthOf(scene.path);
  Slam slam(streetConfig(EstimatorKind::kMsckf), forwardCamera());
  for (std::size_t i = 0; i < scene.frames.size(); ++i)
    slam.process(scene.frames[i].features, odometry[i]);
  SavedMap map = slam.save().map();
  RandomSource random(7);
  PointWorld descriptors(8);
  const std::size_t own = map.landmarks.size();
  map.landmarks.reserve(std::max(own, landmarks));
  while (map.landmarks.size() < landmarks) {
    Landmark landmark = map.landmarks[map.landmarks.size() % own];
    landmark.position_map += Eigen::Vector3d(random.uniform(-500, 500), 2000, 0);
    landmark.descriptor = descriptors.randomDescriptor();
    map.landmarks.push_back(landmark);
  }
  return map;
}

struct Cost {
  std::size_t landmarks = 0;  // of the map that is loaded; some are dropped on the way
  std::size_t written = 0;
  std::vector<double> alone_ms;   // frames
  std::vector<double> saving_ms;  // frames while the map is saved, that of the snapshot included
  double snapshot_ms = 0;
  double gather_ms = 0;  // copies the landmarks, in the writer's thread
  double write_ms = 0;
  double file_mb = 0;
  double read_ms = 0;
};

/// Frames come as in flight, 30 a second, so that the writer has as much time beside them.
Cost costOf(const Scene& scene, const SavedMap& map, const std::string& file) {
  const std::vector<OdometryState> odometry = truthOf(scene.path);
  Slam slam(streetConfig(EstimatorKind::kMsckf), forwardCamera());
  slam.load(map);
  PlaceHint start;
  slam.lookNear(start);
  Cost cost;
  cost.landmarks = map.landmarks.size();
  std::future<void> written;
  Clock::time_point next = Clock::now();
  for (std::size_t i = 0; i < scene.frames.size(); ++i) {
    const bool is_saving =
        written.valid() && written.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    const auto begin = Clock::now();
    slam.process(scene.frames[i].features, odometry[i]);
    const bool is_to_be_saved = i == scene.frames.size() / 2;
    if (is_to_be_saved) {
      if (slam.isSearching()) throw std::runtime_error("the street is not found in its map");
      const auto asked = Clock::now();
      MapSnapshot snapshot = slam.save();
      cost.snapshot_ms = since_ms(asked);
      written = std::async(std::launch::async, [&cost, &file, s = std::move(snapshot)]() mutable {
        const auto start_gathering = Clock::now();
        const SavedMap saved = std::move(s).map();
        cost.gather_ms = since_ms(start_gathering);
        const auto start_writing = Clock::now();
        cost.written = writeMap(file, saved);
        cost.write_ms = since_ms(start_writing);
      });
    }
    const double frame_ms = since_ms(begin);
    constexpr std::size_t kWarm = 100;  // columns and window are full
    if (is_saving || is_to_be_saved) {
      cost.saving_ms.push_back(frame_ms);
    } else if (i > kWarm) {
      cost.alone_ms.push_back(frame_ms);
    }
    next += kPeriod;
    std::this_thread::sleep_until(next);
  }
  written.get();
  cost.file_mb = static_cast<double>(std::filesystem::file_size(file)) * 1e-6;
  const auto start_reading = Clock::now();
  if (readMap(file).landmarks.size() != cost.written) throw std::runtime_error("not what it was");
  cost.read_ms = since_ms(start_reading);
  return cost;
}

void print(const Cost& c) {
  std::printf("| %zu |", c.landmarks);
  for (const std::vector<double>& ms : {c.alone_ms, c.saving_ms})
    std::printf(" %.1f / %.1f / %.1f |", quantile(ms, 0.5), quantile(ms, 0.99), quantile(ms, 1));
  std::printf(" %zu | %.1f | %.2f | %.2f | %.2f | %.0f |\n", c.saving_ms.size(), c.snapshot_ms,
              c.gather_ms * 1e-3, c.write_ms * 1e-3, c.read_ms * 1e-3, c.file_mb);
  std::fflush(stdout);
}

int run(const std::string& folder, bool quick) {
  const Scene scene = streetWith(kFeatures, kFrames);
  const std::string file =
      (std::filesystem::path(folder) / ("map_saving." + std::to_string(::getpid()) + ".vmap"))
          .string();
  std::puts(
      "\n## What saving a large map costs the mapper\n\n"
      "`map_saving`: the simulated street of `mapping_cost`, driven in its own map, to which "
      "landmarks\n"
      "far away have been added; 200 features an image, 30 images a second. The map is saved "
      "once:\n"
      "the mapper's thread takes a snapshot within a frame, a second thread copies it and writes "
      "the\n"
      "file. Milliseconds a frame are median / 99 % / worst.\n\n"
      "| landmarks | frame [ms] | while saving | so many | snapshot [ms] | copied in [s] | written "
      "in "
      "[s] | read in [s] | file [MB] |\n|---|---|---|---|---|---|---|---|---|");
  using Counts = std::vector<std::size_t>;
  for (const std::size_t landmarks :
       quick ? Counts{3000} : Counts{10'000, 100'000, 300'000, 1'000'000})
    print(costOf(scene, largeMap(scene, landmarks), file));
  std::filesystem::remove(file);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures what saving a large map costs the mapper.", "map_saving"};
  std::string folder;
  app.add_option("--folder", folder, "where the map is written")->required();
  bool quick = false;
  app.add_flag("--quick", quick, "only a small map");
  return runTool(app, argc, argv, [&] { return run(folder, quick); });
}
