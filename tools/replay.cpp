// SPDX-License-Identifier: BSD-3-Clause
// replay: images and odometry of a bag or folder through tracker and mapper, without a ROS master.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <future>
#include <iostream>

#include "config_path.hpp"
#include "offline_run.hpp"
#include "parameter_table.hpp"
#include "progress_line.hpp"
#include "run_report.hpp"
#ifdef ARDRONE_VSLAM_WITH_ROS
#include "bag_sequence.hpp"
#include "camera_yaml.hpp"
#endif

namespace {

using namespace ardrone_vslam;
using Json = nlohmann::ordered_json;

struct Options {
  std::string input;
  std::string out;
  std::string config;
  std::vector<std::string> overrides;
  std::string estimator;
  std::string observer_profile;
  std::uint64_t seed = 0;
  std::string seeds;
  std::string frames;
  bool ping_pong = false;
  int threads = 2;
#ifdef ARDRONE_VSLAM_WITH_ROS
  BagReadOptions bag;
  std::string camera_yaml;
#endif
};

void addOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", std::string("replay (ardrone_vslam) " ARDRONE_VSLAM_VERSION));
  app.add_flag_callback(
      "--list-parameters",
      [] {
        std::cout << parameterTable();
        throw CLI::Success();
      },
      "print all parameters (docs/parameters.md) and exit");
  app.add_option("input", o.input, "a bag, or a KITTI or TUM-like folder")->required();
  app.add_option("--out", o.out, "folder for trajectories, frames.csv, landmarks.csv, summary.json")
      ->required();
  app.add_option("--config", o.config, "yaml with sections tracker and mapper (config/*.yaml)");
  app.add_option("--set", o.overrides, "key=value over the configuration; may be repeated")
      ->take_all();
  app.add_option("--estimator", o.estimator, "thesis or observer; over the configuration");
  app.add_option("--observer-profile", o.observer_profile,
                 "corrupt the truth like this (truth, wheel, drone, hover, harsh); default: the "
                 "input's own odometry, else wheel");
  auto* seed = app.add_option("--seed", o.seed, "of the observer's noise");
  app.add_option("--seeds", o.seeds, "A:B, runs the seeds A to B and prints median and worst")
      ->excludes(seed);
  app.add_option("--frames", o.frames, "A:B:STEP, frames A up to but without B");
  app.add_flag("--ping-pong", o.ping_pong, "even frames forward, then odd frames backward");
  app.add_option("--threads", o.threads,
                 "2: decode ahead, spread the seeds; results do not depend on it")
      ->check(CLI::Range(1, 256));
#ifdef ARDRONE_VSLAM_WITH_ROS
  app.add_option("--image-topic", o.bag.image_topic, "of a bag; default: the only one there is");
  app.add_option("--camera-info-topic", o.bag.camera_info_topic,
                 "of a bag; default: beside the images");
  app.add_option("--odometry-topic", o.bag.odometry_topic,
                 "of a bag; default: the only one there is");
  app.add_option("--truth-topic", o.bag.truth_topic, "of a bag; default: the one called truth");
  app.add_option("--camera-frame", o.bag.camera_frame, "of a bag; default: the images' frame_id");
  app.add_option("--base-frame", o.bag.base_frame,
                 "of a bag; default: the odometry's child_frame_id");
  app.add_option("--camera", o.camera_yaml, "calibration to use instead of a bag's camera_info");
#endif
}

std::unique_ptr<Sequence> openInput(const Options& o) {
  if (std::filesystem::is_directory(o.input)) return openFolder(o.input);
#ifdef ARDRONE_VSLAM_WITH_ROS
  BagReadOptions options = o.bag;
  if (!o.camera_yaml.empty()) options.camera = readCameraYaml(o.camera_yaml);
  auto bag = openBag(o.input, options);
  for (const std::string& warning : bag->warnings()) std::cerr << "replay: " << warning << '\n';
  return bag;
#else
  throw std::runtime_error(
      o.input + ": is no folder, and this replay was built without ROS, so it reads no bags");
#endif
}

std::vector<std::uint64_t> seedsOf(const Options& o) {
  if (o.seeds.empty()) return {o.seed};
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  char rest = 0;
  if (std::sscanf(o.seeds.c_str(), "%lu:%lu%c", &first, &last, &rest) != 2 || last < first ||
      last - first > 9999) {
    throw CLI::ValidationError("--seeds",
                               "'" + o.seeds + "' must be A:B with A <= B, for example 1:5");
  }
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  return seeds;
}

/// The observers to run with, one a seed, and what they are called.
struct Observers {
  std::string profile;
  std::vector<std::uint64_t> seeds;
  std::vector<ObserverRun> runs;
};

Observers observersOf(const Sequence& sequence, const Options& o) {
  Observers observers;
  observers.seeds = seedsOf(o);
  if (o.observer_profile.empty() && !sequence.observer().empty()) {
    if (!o.seeds.empty()) {
      throw std::runtime_error(
          sequence.name() +
          ": --seeds needs --observer-profile: the recorded odometry has no seed");
    }
    observers.profile = "recorded";
    observers.runs.push_back({sequence.observer(), sequence.observerScaleError()});
    return observers;
  }
  observers.profile = o.observer_profile.empty() ? "wheel" : o.observer_profile;
  if (sequence.truth().empty()) {
    throw std::runtime_error(
        sequence.name() +
        ": has neither odometry nor true poses, so there is no observer to run with; " +
        "add the odometry to the bag, or poses.txt / poses_tum.txt to the folder");
  }
  const ObserverProfile profile =
      loadObserverProfile(observers.profile, findConfigFile("observer_profiles.yaml"));
  for (const std::uint64_t seed : observers.seeds)
    observers.runs.push_back(simulateObserver(sequence.truth(), profile, seed));
  return observers;
}

/// Calls work(i) for i = 0 .. count - 1, spread over at most `threads` threads.
template <class Work>
void forEach(std::size_t count, int threads, const Work& work) {
  const std::size_t workers = std::min(count, static_cast<std::size_t>(threads));
  std::vector<std::future<void>> others;
  const auto share = [&](std::size_t worker) {
    for (std::size_t i = worker; i < count; i += workers) work(i);
  };
  for (std::size_t worker = 1; worker < workers; ++worker) {
    others.push_back(std::async(std::launch::async, share, worker));
  }
  share(0);
  for (auto& other : others) other.get();
}

std::vector<RunResult> runAll(Sequence& sequence, const PipelineConfig& config,
                              const Observers& observers, int threads) {
  std::vector<std::unique_ptr<BackEnd>> back_ends;
  for (const ObserverRun& run : observers.runs) {
    back_ends.push_back(
        std::make_unique<BackEnd>(config.mapper, sequence.T_base_cam(), run.states));
  }
  ProgressLine progress("replay", sequence.size());
  std::size_t done = 0;
  // The front end does not depend on the observer: it runs once for all seeds.
  runFrontEnd(sequence, config.tracker, threads, [&](const TrackedFrame& frame) {
    forEach(back_ends.size(), threads, [&](std::size_t i) { back_ends[i]->process(frame); });
    progress.update(++done);
  });
  std::vector<RunResult> results;
  for (std::size_t i = 0; i < back_ends.size(); ++i) {
    results.push_back(back_ends[i]->finish());
    results.back().scale_error = observers.runs[i].scale_error;
  }
  return results;
}

std::string shown(const Json& value) {
  return value.is_null() ? "-" : value.dump();
}

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

int run(const Options& o) {
  std::vector<std::string> overrides = o.overrides;
  if (!o.estimator.empty()) overrides.push_back("mapper/estimator=" + o.estimator);
  const PipelineConfig config = loadConfig(o.config, overrides);
  const auto sequence = select(openInput(o), FrameSelection::parse(o.frames, o.ping_pong));
  const Observers observers = observersOf(*sequence, o);
  const std::vector<RunResult> results = runAll(*sequence, config, observers, o.threads);

  std::vector<Json> summaries;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const RunEvaluation evaluation = evaluate(results[i], sequence->truth());
    const RunLabel label{sequence->name(), observers.profile, observers.seeds[i],
                         nameOf(config.mapper.estimator)};
    summaries.push_back(summaryOf(results[i], evaluation, label));
    const std::string folder =
        o.seeds.empty() ? o.out : o.out + "/seed_" + std::to_string(label.seed);
    writeRun(folder, results[i], evaluation, summaries.back());
    if (results[i].frames.empty()) {
      throw std::runtime_error(
          sequence->name() +
          ": no image has odometry at its stamp; the stamps of images and odometry do not "
          "overlap, or the odometry's gaps are longer than observer_max_gap_s");
    }
  }
  if (o.seeds.empty()) {
    printSummary(summaries.front());
  } else {
    const Json all = summaryOfSeeds(summaries);
    writeText(o.out + "/summary.json", all.dump(2) + "\n");
    printSeeds(all);
  }
  std::cout << "written to " << o.out << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Runs a bag or an image folder through tracker and mapper, offline and deterministic, and "
      "compares with the truth."};
  Options options;
  addOptions(app, options);
  try {
    app.parse(argc, argv);
    return run(options);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const std::exception& e) {
    std::cerr << "replay: " << e.what() << '\n';
    return 1;
  }
}
