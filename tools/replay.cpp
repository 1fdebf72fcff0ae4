// SPDX-License-Identifier: BSD-3-Clause
// replay: images and odometry of a bag or folder through tracker and mapper, without a ROS master.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "config_files/config_path.hpp"
#include "folders/kitti_folder.hpp"
#include "parameters/parameter_table.hpp"
#include "program/map_options.hpp"
#include "program/profile_option.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"
#include "refine/refine_runs.hpp"
#include "report/earlier_run.hpp"
#include "report/report_runs.hpp"
#include "report/run_files.hpp"
#include "report/run_page.hpp"
#include "report/unfinished_runs.hpp"
#include "run/loaded_map.hpp"
#include "run/recorded_inputs.hpp"
#include "run/run_all.hpp"
#include "run/run_odometry.hpp"
#include "sequences/faulty_sequence.hpp"
#include "sequences/similar_sequence.hpp"
#ifdef ARDRONE_VSLAM_WITH_ROS
#include "bags/bag_options.hpp"
#include "bags/bag_sequence.hpp"
#endif

namespace {

using namespace ardrone_vslam;

struct Options {
  std::string input;
  std::string out;
  std::string config;
  std::vector<std::string> overrides;
  std::string estimator;
  std::string odometry_profile;
  std::uint64_t seed = 0;
  CLI::Option* seed_option = nullptr;
  std::string seeds;
  bool is_odometry_at_zero = false;
  MapOptions maps;
  std::string frames;
  bool ping_pong = false;
  bool whole_pixels = false;
  Similarity similarity;
  std::string setup_fault;
  bool report = false;
  int threads = 2;
  ComputerSpeed speed;
  CLI::Option* image_ms_option = nullptr;
  CLI::Option* cpu_factor_option = nullptr;
#ifdef ARDRONE_VSLAM_WITH_ROS
  BagOptions bag;
#endif
};

/// What is made of the input.
void addSequenceOptions(CLI::App& app, Options& o) {
  app.add_option("--frames", o.frames, "A:B:STEP, frames A up to but without B");
  app.add_flag("--ping-pong", o.ping_pong, "even frames forward, then odd frames backward");
  app.add_option("--world-scale", o.similarity.scale,
                 "a scene and flight so many times as large, at the same speed: the truth's "
                 "positions and all stamps are multiplied (default 1)")
      ->check(numberWithin(0.001, 1000.0));
  app.add_flag("--mirror-world", o.similarity.is_mirrored,
               "images, camera and truth, left to right: as true as before");
  app.add_option("--setup-fault", o.setup_fault,
                 "make the set-up wrong, to see what becomes of it: mirrored, late=SECONDS, "
                 "focal=FACTOR, roll=, pitch= or yaw=DEGREES (of the camera)");
}

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
  app.add_option(
         "--out", o.out,
         "folder for trajectories, frames.csv, landmarks.csv, summary.json; with --seeds in "
         "seed_N/ each. What an earlier run left there is removed, other files are kept")
      ->required();
  app.add_option(
      "--config", o.config,
      "yaml with sections tracker and mapper (config/*.yaml); default: none, for a KITTI folder "
      "kitti.yaml");
  app.add_option("--set", o.overrides, "key=value over the configuration; may be repeated")
      ->allow_extra_args(false)
      ->take_all();
  app.add_option("--estimator", o.estimator, "over the configuration")
      ->check(CLI::IsMember({"thesis", "msckf", "odometry"}));
  app.add_option(
      "--odometry-profile", o.odometry_profile,
      "corrupt the truth like this (truth, wheel, wheels, drone, hover, harsh; A,B@S: A, from "
      "second S on B); default: the input's own odometry, else wheel for a KITTI "
      "folder, drone for the others");
  o.seed_option = addSeed(app, "--seed", o.seed, "of the odometry's noise");
  app.add_option("--seeds", o.seeds, "A:B, runs the seeds A to B and prints median and worst")
      ->excludes(o.seed_option);
  app.add_flag(
      "--odometry-at-zero", o.is_odometry_at_zero,
      "simulated odometry begins at the origin, heading 0, as of a drone switched on there");
  addSequenceOptions(app, o);
  o.maps.addTo(app);
  app.add_flag("--whole-pixels", o.whole_pixels,
               "tracks are not aligned between pixels, as the thesis has them");
  app.add_flag("--report", o.report,
               "also report.html, a page with tables and plots (docs/evaluate.md)");
  o.image_ms_option =
      app.add_option("--image-ms", o.speed.image_ms,
                     "emulate a computer that needs so long for an image; of those that arrive "
                     "meanwhile the newest waits, the others are dropped. The same each time")
          ->check(numberWithin(0.0, 1e6));
  o.cpu_factor_option =
      app.add_option("--cpu-factor", o.speed.cpu_factor,
                     "emulate one that needs so many times what an image takes here (decoding "
                     "left out), or what --image-ms says")
          ->check(numberWithin(0.0, 1e6));
  app.add_option("--threads", o.threads,
                 "2: decode ahead, spread the seeds; results do not depend on it")
      ->check(CLI::Range(1, 256));
#ifdef ARDRONE_VSLAM_WITH_ROS
  o.bag.addTo(app);
#endif
}

/// @param faults  gets a sentence when so much of a bag was dropped that the results are not of
/// what was recorded
std::unique_ptr<Sequence> openInput(const Options& o, const PipelineConfig& config,
                                    std::vector<std::string>& faults) {
  const bool is_folder = std::filesystem::is_directory(o.input);
#ifdef ARDRONE_VSLAM_WITH_ROS
  if (is_folder) {
    o.bag.refuseForFolder(o.input);
    return openFolder(o.input);
  }
  auto bag = openBag(o.input, o.bag.read(config));
  for (const std::string& text : bag->findings().warnings) std::cerr << "replay: " << text << '\n';
  if (bag->findings().has_lost_much)
    faults.push_back(o.input +
                     ": more than 5 % of a topic's messages were dropped (see above); "
                     "the results are of the rest");
  return bag;
#else
  static_cast<void>(config);
  static_cast<void>(faults);
  if (is_folder) return openFolder(o.input);
  throw std::runtime_error(
      o.input + ": is no folder, and this replay was built without ROS, so it reads no bags");
#endif
}

/// @return nothing: a computer that has time for all images
std::optional<ComputerSpeed> speedOf(const Options& o) {
  if (o.image_ms_option->count() + o.cpu_factor_option->count() == 0) return {};
  if (!o.speed.image_ms && !o.seeds.empty()) {
    throw UsageError(
        "--cpu-factor: what an image takes differs from seed to seed, but --seeds share the "
        "images; give one --seed, or --image-ms");
  }
  return o.speed;
}

std::vector<RunOdometry> odometriesOf(const Sequence& sequence, const Options& o) {
  // A bag is what was recorded; image folders have no odometry of their own and get a simulated
  // one.
  const bool is_bag = !std::filesystem::is_directory(o.input);
  if (o.odometry_profile.empty() && is_bag && o.ping_pong) {
    throw UsageError(sequence.name() +
                     ": --ping-pong: recorded odometry cannot run backwards; corrupt the truth "
                     "instead, by --odometry-profile (drone, say)");
  }
  if (o.odometry_profile.empty() && (is_bag || !sequence.odometry().empty())) {
    if (!o.seeds.empty() || o.seed_option->count() > 0) {
      throw UsageError(sequence.name() + (o.seeds.empty() ? ": --seed" : ": --seeds") +
                       " needs --odometry-profile: the recorded odometry has no seeds");
    }
    return {recordedOdometry(sequence)};
  }
  const std::string profile =
      o.odometry_profile.empty() ? defaultProfile(o.input) : o.odometry_profile;
  const std::vector<std::uint64_t> seeds =
      o.seeds.empty() ? std::vector{o.seed} : parseSeeds(o.seeds);
  return simulatedOdometries(sequence, profile, seeds, o.is_odometry_at_zero);
}

RunMaps mapsOf(const Options& o, const Sequence& sequence, const PipelineConfig& config) {
  std::string fault = o.maps.is_refined ? "--refine: this replay was built without Ceres 2"
                                        : faultOfMaps(config.mapper);
#ifdef ARDRONE_VSLAM_WITH_CERES
  if (o.maps.is_refined) fault = faultOfRefining(config.mapper);
#endif
  const bool is_saved = !o.maps.saved.empty();
  RunMaps maps{std::nullopt, is_saved, is_saved || o.maps.is_refined};
  if (!fault.empty() && (maps.is_recorded || !o.maps.loaded.empty())) throw UsageError(fault);
  if (!o.maps.loaded.empty())
    maps.loaded = loadMap(o.maps.loaded, sequence.camera(), config.mapper);
  return maps;
}

/// What is wrong with the file is a fault of the input, what --set adds to it wrong usage.
PipelineConfig configOf(const Options& given) {
  Options o = given;
  if (o.config.empty() && isKittiFolder(o.input)) {
    o.config = findConfigFile("kitti.yaml");
    std::fprintf(stderr, "replay: a KITTI folder, so with %s (--config names another)\n",
                 o.config.c_str());
  }
  std::vector<std::string> overrides = o.overrides;
  if (!o.estimator.empty()) overrides.push_back("mapper/estimator=" + o.estimator);
  if (o.maps.localise_only) overrides.emplace_back("mapper/localise_only=true");
  PipelineConfig config = loadConfig(o.config, {});
  if (overrides.empty()) return config;
  try {
    return loadConfig(o.config, overrides);
  } catch (const ConfigError& e) {
    throw UsageError(e.what());
  }
}

void checkOdometry(const Options& o, const PipelineConfig& config) {
  if (!o.odometry_profile.empty()) profileOfOption(o.odometry_profile);
  const OdometryMode mode = config.mapper.odometry_adapter.mode;
  const bool is_of_bags = mode == OdometryMode::kNavdata || mode == OdometryMode::kImu;
  if (is_of_bags && (std::filesystem::is_directory(o.input) || !o.odometry_profile.empty())) {
    throw UsageError(o.input +
                     ": odometry_mode navdata and imu are of bags, without "
                     "--odometry-profile; set it to pose or twist");
  }
}

void append(const std::vector<std::string>& more, std::vector<std::string>& faults) {
  faults.insert(faults.end(), more.begin(), more.end());
}

int run(const Options& o) {
  PipelineConfig config = configOf(o);
  config.tracker.align_tracks = !o.whole_pixels;
  checkOdometry(o, config);
  const std::optional<ComputerSpeed> speed = speedOf(o);
  const FrameSelection selection =
      asUsage([&o] { return FrameSelection::parse(o.frames, o.ping_pong); });
  std::vector<std::string> faults;
  auto sequence = select(openInput(o, config, faults), selection);
  if (o.similarity.scale != 1 || o.similarity.is_mirrored)
    sequence = withSimilarity(std::move(sequence), o.similarity);
  if (!o.setup_fault.empty())
    sequence = asUsage([&] { return withFault(std::move(sequence), o.setup_fault); });
  checkHeights(*sequence, config.mapper.height_input);
  const std::vector<RunOdometry> odometries = odometriesOf(*sequence, o);
  const RunMaps maps = mapsOf(o, *sequence, config);
  makeRunFolder(o.out);
  if (!o.maps.saved.empty()) checkWritable(o.maps.saved);
  const std::string evaluate_script = o.report ? findEvaluateScript() : "";
  const auto tell = [](const std::string& text) { std::cerr << "replay: " << text << '\n'; };
  const ReportOptions report{o.out, !o.seeds.empty(), nameOf(config.mapper.estimator), tell};
  auto progress = std::make_unique<ProgressLine>("replay", sequence->size());
  UnfinishedRuns unfinished(*sequence, odometries, report);
  const auto show = [&](std::size_t done, const ResultsSoFar& so_far) {
    progress->update(done);
    unfinished.offer(so_far);
  };
  std::vector<RunResult> results =
      runAll(*sequence, config, odometries, o.threads, show, speed, maps);
  progress.reset();  // ends its line
#ifdef ARDRONE_VSLAM_WITH_CERES
  if (o.maps.is_refined) append(refineRuns(results), faults);
#endif
  if (!unfinished.hasWritten()) removeEarlierRun(o.out);
  append(reportRuns(*sequence, odometries, results, report), faults);
  if (const auto& map = results.front().map)
    append(o.maps.save(*map, "replay " ARDRONE_VSLAM_VERSION), faults);
  std::cout << "written to " << o.out << '\n';
  if (o.report) writeRunPage(evaluate_script, o.out);
  for (const std::string& text : faults) tell(text);
  return faults.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Runs a bag or an image folder through tracker and mapper, offline and deterministic, and "
      "compares with the truth.",
      "replay"};
  Options options;
  addOptions(app, options);
  return runTool(app, argc, argv, [&options] { return run(options); });
}
