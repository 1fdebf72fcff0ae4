// SPDX-License-Identifier: BSD-3-Clause
// simulate_landmarks: a known path, landmarks beside it and a drifting odometry through the mapper:
// what the estimators make of a long way when calibration and mounting are exact.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "landmarks/simulated_street.hpp"
#include "program/profile_option.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"
#include "report/run_files.hpp"
#include "run/run_all.hpp"
#include "sequences/sequence.hpp"
#include "summary/seeds_summary.hpp"
#include "trajectory/metrics.hpp"
#include "trajectory/text_file.hpp"

namespace {

constexpr double kShortestStreet_m = 1;

using namespace ardrone_vslam;
using Json = nlohmann::ordered_json;

struct Options {
  std::string path;
  std::string out;
  std::string config;
  std::vector<std::string> overrides;
  std::vector<std::string> estimators{"thesis", "msckf"};
  std::string odometry_profile = "wheel";
  std::string seeds = "1:5";
  std::uint64_t world_seed = 1;
  std::string frames;
  StreetConfig street;
  ViewFaults faults;
  std::vector<std::string> peers;
  int threads = 2;
};

void addOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version",
                       std::string("simulate_landmarks (ardrone_vslam) " ARDRONE_VSLAM_VERSION));
  app.add_option("path", o.path, "true poses: KITTI's (times.txt beside it, else 10 Hz) or TUM's")
      ->required();
  app.add_option("--out", o.out, "folder for summary.json and each run's files")->required();
  app.add_option("--config", o.config, "yaml with sections tracker and mapper (config/*.yaml)");
  app.add_option("--set", o.overrides, "key=value over the configuration; may be repeated")
      ->allow_extra_args(false)
      ->take_all();
  app.add_option("--estimator", o.estimators, "one or more, by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"thesis", "msckf", "odometry"}))
      ->capture_default_str();
  app.add_option("--odometry-profile", o.odometry_profile, "corrupt the path like this")
      ->capture_default_str();
  app.add_option("--seeds", o.seeds, "A:B, of the odometry's noise")->capture_default_str();
  addSeed(app, "--world-seed", o.world_seed, "of the landmarks and of what the camera sees");
  app.add_option("--frames", o.frames, "A:B:STEP, poses A up to but without B");
  app.add_option("--landmarks", o.street.landmarks, "beside the whole path")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  app.add_option("--pixel-noise", o.faults.pixel_noise_px, "deviation of a corner per axis [px]")
      ->check(numberWithin(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--wrong", o.faults.wrong_share, "share of wrong corners")
      ->check(numberWithin(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--lost", o.faults.lost_share, "share of the landmarks in view that are not found")
      ->check(numberWithin(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--peer", o.peers,
                 "NAME=FILE, another system's poses of the same path, as a row beside; may be "
                 "repeated")
      ->allow_extra_args(false)
      ->take_all();
  app.add_option("--threads", o.threads, "spread the runs; results do not depend on it")
      ->check(CLI::Range(1, 256));
}

PipelineConfig configOf(const Options& o, const std::string& estimator) {
  std::vector<std::string> overrides = o.overrides;
  overrides.push_back("mapper/estimator=" + estimator);
  try {
    return loadConfig(o.config, overrides);
  } catch (const ConfigError& e) {
    throw UsageError(e.what());
  }
}

Trajectory selected(const Trajectory& path, const std::string& frames) {
  const FrameSelection selection =
      asUsage([&frames] { return FrameSelection::parse(frames, false); });
  std::vector<StampedPose> poses;
  const std::size_t end = std::min(selection.end.value_or(path.size()), path.size());
  for (std::size_t i = selection.begin; i < end; i += selection.step)
    poses.push_back(path.poses()[i]);
  if (poses.size() < 2) throw UsageError("--frames: fewer than two poses are left");
  return Trajectory(std::move(poses));
}

/// Another system's row. Its poses are those of the whole path's frames.
Json peerRow(const std::string& argument, const Trajectory& truth, const std::string& frames) {
  const auto split = argument.find('=');
  if (split == std::string::npos) throw UsageError("--peer: '" + argument + "' must be NAME=FILE");
  const std::string file = argument.substr(split + 1);
  const Trajectory peer = selected(readPath(file), frames);
  if (peer.size() != truth.size()) {
    throw std::runtime_error(file + ": has " + std::to_string(peer.size()) + " poses for the " +
                             std::to_string(truth.size()) +
                             " of the path; give one for each, in the same order");
  }
  Json row;
  row["name"] = argument.substr(0, split);
  row["ate_rmse_m"] = summarise(positionErrors_m(peer, truth)).rmse_m;
  row["ate_rmse_aligned_m"] = alignedRmse_m(peer, truth);
  const auto t_rel = translationError_percent(peer, truth);
  row["t_rel_percent"] = t_rel ? Json(*t_rel) : Json(nullptr);
  return row;
}

/// Features of the selected frames, to all back ends; the landmarks are those of the whole path.
void runThrough(const Options& o, const Trajectory& path, const Trajectory& truth,
                const FrameTrackerConfig& tracks, BackEnds& back_ends) {
  PointWorld world(o.world_seed, o.faults, streetCamera(), tracks);
  addStreet(world, path, o.street, o.world_seed);
  ProgressLine progress("simulate_landmarks", truth.size());
  TrackedFrame frame;
  std::size_t done = 0;
  for (const StampedPose& pose : truth.poses()) {
    frame.features = world.look(pose.T_frame_body * forwardCamera(), pose.stamp_ns);
    back_ends.process(frame);
    progress.update(++done);
  }
}

std::string number(const Json& value, int digits) {
  if (!value.is_number()) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", digits, value.get<double>());
  return text;
}

constexpr const char* kColumns[] = {"odometry_ate_rmse_m",      "fused_ate_rmse_m",
                                    "fused_ate_rmse_aligned_m", "ratio",
                                    "ratio_scale_removed",      "odometry_error_last_m",
                                    "fused_error_last_m",       "nees_mean",
                                    "outside_3_sigma",          "t_rel_percent",
                                    "odometry_t_rel_percent",   "ms_per_frame_median"};

void printRow(const std::string& name, const Json& row) {
  std::cout << name;
  for (const char* column : kColumns)
    std::cout << ", " << (row.contains(column) ? number(row[column], 3) : "-");
  std::cout << '\n';
}

void print(const Json& all) {
  std::cout << "run";
  for (const char* column : kColumns) std::cout << ", " << column;
  std::cout << '\n';
  for (const auto& [estimator, summary] : all["estimators"].items()) {
    for (const Json& run : summary["runs"])
      printRow(estimator + " seed " + run["seed"].dump(), run);
    for (const char* kind : {"median", "worst"}) printRow(estimator + " " + kind, summary[kind]);
  }
  for (const Json& peer : all["peers"]) {
    std::cout << peer["name"].get<std::string>() << ": ate_rmse_m " << number(peer["ate_rmse_m"], 2)
              << ", ate_rmse_aligned_m " << number(peer["ate_rmse_aligned_m"], 2)
              << ", t_rel_percent " << number(peer["t_rel_percent"], 3) << '\n';
  }
}

int run(const Options& o) {
  const OdometryProfile profile = profileOfOption(o.odometry_profile);
  std::vector<PipelineConfig> configs;
  for (const std::string& estimator : o.estimators) configs.push_back(configOf(o, estimator));
  const Trajectory path = readPath(o.path);
  const Trajectory truth = selected(path, o.frames);
  if (!(distancesAlong_m(path).back() >= kShortestStreet_m))
    throw std::runtime_error(o.path +
                             ": its poses do not move by a metre in all, so there is no "
                             "street beside them; give a longer path");
  Json all;
  all["path"] = o.path;
  all["frames"] = truth.size();
  all["landmarks"] = o.street.landmarks;
  all["pixel_noise_px"] = o.faults.pixel_noise_px;
  all["wrong_share"] = o.faults.wrong_share;
  all["lost_share"] = o.faults.lost_share;
  all["world_seed"] = o.world_seed;
  all["peers"] = Json::array();
  for (const std::string& peer : o.peers) all["peers"].push_back(peerRow(peer, truth, o.frames));

  std::vector<RunOdometry> odometries;
  for (const std::uint64_t seed : parseSeeds(o.seeds))
    odometries.push_back({profile.name, seed, simulateOdometry(truth, profile, seed)});
  BackEnds back_ends(o.threads);
  for (const PipelineConfig& config : configs) {
    for (const RunOdometry& odometry : odometries)
      back_ends.add(config.mapper, forwardCamera(), odometry);
  }
  std::filesystem::create_directories(o.out);
  runThrough(o, path, truth, configs.front().tracker.tracks, back_ends);

  const std::vector<RunResult> results = back_ends.results(true);
  auto result = results.begin();
  for (const std::string& estimator : o.estimators) {
    std::vector<Json> summaries;
    for (const RunOdometry& odometry : odometries) {
      const RunEvaluation evaluation = evaluate(*result, truth);
      summaries.push_back(
          summaryOf(*result, evaluation,
                    {"simulated landmarks", odometry.profile, odometry.seed, estimator}));
      writeRun(o.out + "/" + estimator + "/seed_" + std::to_string(*odometry.seed), *result,
               evaluation, summaries.back());
      ++result;
    }
    all["estimators"][estimator] = summaryOfSeeds(summaries);
  }
  writeText(o.out + "/summary.json", all.dump(2) + "\n");
  print(all);
  std::cout << "written to " << o.out << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Puts landmarks beside a known path, lets a camera see them and odometry drift, and "
      "compares the mapper's estimators with the path.",
      "simulate_landmarks"};
  Options options;
  options.faults.pixel_noise_px = 0.8;
  options.faults.wrong_share = 0.03;
  addOptions(app, options);
  return runTool(app, argc, argv, [&options] { return run(options); });
}
