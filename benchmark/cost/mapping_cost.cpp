// SPDX-License-Identifier: BSD-3-Clause
// mapping_cost: milliseconds a frame of the mapper's stages, against the features of an image and
// against the landmarks of the map. Synthetic: a street with landmarks beside it, true odometry.

#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>

#include "ardrone_vslam/landmark.hpp"
#include "association/associator.hpp"
#include "map/landmark_map.hpp"
#include "program/tool_main.hpp"
#include "run/offline_run.hpp"
#include "sequences/sequence.hpp"
#include "simulation/random_source.hpp"
#include "street_scene.hpp"
#include "trajectory/metrics.hpp"

namespace {

using namespace ardrone_vslam;

constexpr int kWarmUp = 60;  // frames until window and anchors are full
constexpr int kMeasured = 120;

struct Cost {
  double features = 0;
  double landmarks = 0;
  double in_view = 0;
  double tracks = 0;
  double associate_ms = 0;
  double localise_ms = 0;
  double map_ms = 0;
};

/// Over the frames that used tracks: between its keyframes the MSCKF does next to nothing.
double medianOf(const std::vector<RunFrame>& frames,
                const std::function<double(const RunFrame&)>& value) {
  std::vector<double> values;
  for (std::size_t i = kWarmUp; i < frames.size(); ++i) {
    if (frames[i].result.feature_candidates > 0) values.push_back(value(frames[i]));
  }
  return quantile(std::move(values), 0.5);
}

/// The thread's own time: other work on the machine does not count.
class StageCpu {
 public:
  explicit StageCpu(StageTimes_ms& times_ms) : times_ms_(times_ms) {}
  StageHook hook() {
    return [this](Stage stage) {
      const double now = now_ms();
      if (stage_ != Stage::kIdle) times_ms_[static_cast<std::size_t>(stage_)] += now - since_ms_;
      stage_ = stage;
      since_ms_ = now;
    };
  }

 private:
  static double now_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  }

  StageTimes_ms& times_ms_;
  Stage stage_ = Stage::kIdle;
  double since_ms_ = 0;
};

Cost costOf(const Scene& scene, EstimatorKind estimator) {
  const std::vector<OdometryState> odometry = truthOf(scene.path);
  Slam slam(streetConfig(estimator), forwardCamera());
  RunResult run;
  for (std::size_t i = 0; i < scene.frames.size(); ++i) {
    RunFrame frame;
    StageCpu cpu(frame.times_ms);
    frame.result = slam.process(scene.frames[i].features, odometry[i], cpu.hook());
    run.frames.push_back(std::move(frame));
  }
  const auto ms = [](Stage stage) {
    return [stage](const RunFrame& f) { return f.times_ms[static_cast<std::size_t>(stage)]; };
  };
  Cost cost;
  cost.features = medianOf(run.frames, [](const RunFrame& f) { return f.result.features; });
  cost.landmarks = medianOf(run.frames, [](const RunFrame& f) { return f.result.landmarks; });
  cost.in_view = medianOf(run.frames, [](const RunFrame& f) { return f.result.landmarks_in_view; });
  cost.tracks = medianOf(run.frames, [](const RunFrame& f) { return f.result.feature_matches; });
  cost.associate_ms = medianOf(run.frames, ms(Stage::kAssociate));
  cost.localise_ms = medianOf(run.frames, ms(Stage::kLocalise));
  cost.map_ms = medianOf(run.frames, ms(Stage::kMap));
  return cost;
}

/// A map of so many landmarks around the place where an image is matched: what remains of a long
/// flight, of which only those near the camera can be in view. And, as `map_ms`, what the image
/// costs in which such a map is full (once for each tenth of max_landmarks that is made anew).
Cost costOfMap(const Scene& scene, int landmarks) {
  RandomSource random(7);
  LandmarkMapConfig map_config;
  map_config.max_landmarks = landmarks;
  LandmarkMap map(map_config);
  PointWorld descriptors(8);
  // 12 a metre of street, as KITTI 00's 45,000 on 3.7 km; the streets form a square grid.
  const double side_m = std::max(200.0, std::sqrt(landmarks / 12.0 * 50));
  for (int i = 0; i < landmarks; ++i) {
    Landmark landmark;
    landmark.position_map << random.uniform(-side_m / 2, side_m / 2),
        random.uniform(-side_m / 2, side_m / 2), random.uniform(-1.6, 6);
    landmark.descriptor = descriptors.randomDescriptor();
    landmark.sigma_m = 0.1F;
    landmark.seen_distance_m = static_cast<float>(random.uniform(8, 40));
    const auto heading = static_cast<float>(random.uniform(0, 2 * M_PI));
    landmark.view_direction_map << std::cos(heading), std::sin(heading), 0;
    map.add(landmark);
  }
  Associator associator(AssociationConfig{});
  Cost cost;
  std::vector<double> times_ms;
  std::vector<double> in_view;
  FrameView view;
  AssociationResult result;
  for (std::size_t i = kWarmUp; i < kWarmUp + 30; ++i) {
    const ImageFeatures& features = scene.frames[i].features;
    view.reset(features, scene.path.poses()[i].T_frame_body * forwardCamera(), false);
    view.setPositionVariance(0.01, true);
    StageTimes_ms stage_ms{};
    StageCpu cpu(stage_ms);
    const StageHook hook = cpu.hook();
    hook(Stage::kAssociate);
    associator.matchLandmarks(view, map, result);
    hook(Stage::kIdle);
    if (i < kWarmUp + 5) continue;  // the columns are filled at the first call
    times_ms.push_back(stage_ms[static_cast<std::size_t>(Stage::kAssociate)]);
    in_view.push_back(result.in_view);
    cost.features = static_cast<double>(features.size());
  }
  cost.landmarks = landmarks;
  cost.associate_ms = quantile(times_ms, 0.5);
  cost.in_view = quantile(in_view, 0.5);
  map.add(map.all().front());
  StageTimes_ms stage_ms{};
  StageCpu cpu(stage_ms);
  const StageHook hook = cpu.hook();
  hook(Stage::kMap);
  map.enforceCap();
  hook(Stage::kIdle);
  cost.map_ms = stage_ms[static_cast<std::size_t>(Stage::kMap)];
  return cost;
}

void write(std::ostream& out, const char* series, const Cost& c) {
  out << series << ',' << c.features << ',' << c.landmarks << ',' << c.in_view << ',' << c.tracks
      << ',' << c.associate_ms << ',' << c.localise_ms << ',' << c.map_ms << std::endl;
}

int run(const std::string& path, bool quick) {
  std::ofstream out(path);
  if (!out) throw std::runtime_error(path + ": cannot be written; choose another --out");
  out << "series,features,landmarks,in_view,tracks,associate_ms,localise_ms,map_ms\n";
  using Counts = std::vector<int>;
  for (const int features : quick ? Counts{50} : Counts{50, 100, 200, 400, 600, 1000, 1500, 2000}) {
    const Scene scene = streetWith(features, kWarmUp + kMeasured);
    write(out, "thesis", costOf(scene, EstimatorKind::kThesis));
    write(out, "msckf", costOf(scene, EstimatorKind::kMsckf));
    std::cerr << features << " features\n";
  }
  const Scene scene = streetWith(quick ? 50 : 600, kWarmUp + kMeasured);
  for (const int landmarks :
       quick ? Counts{1000} : Counts{1000, 3000, 10000, 30000, 100000, 300000, 1000000}) {
    write(out, "map", costOfMap(scene, landmarks));
    std::cerr << landmarks << " landmarks\n";
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures what a frame costs the mapper.", "mapping_cost"};
  std::string out;
  app.add_option("--out", out, "csv, a line a measurement")->required();
  bool quick = false;
  app.add_flag("--quick", quick, "only the smallest of each series");
  return runTool(app, argc, argv, [&] { return run(out, quick); });
}
