// SPDX-License-Identifier: BSD-3-Clause
// make_world: renders a flight through a synthetic world, as a bag or as a TUM-like folder.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#ifdef ARDRONE_VSLAM_WITH_ROS
#include "bag_writer.hpp"
#endif
#include "profile_option.hpp"
#include "progress_line.hpp"
#include "tool_main.hpp"
#include "tum_folder_writer.hpp"
#include "world_sequence.hpp"

namespace {

using namespace ardrone_vslam;

struct Options {
  WorldOptions world;
  std::string out;
  bool force = false;
  std::string observer_profile;
  std::string start;  // "X,Y,YAW" [m, m, rad]; empty: the flight's own
  std::string images = "raw";
  std::string compression = "none";
  std::string camera = "front";
  std::string gain = "1";
  double shutter_ms = 0;
  double readout_ms = 0;
  const CLI::Option* seconds = nullptr;
  const CLI::Option* shutter = nullptr;
  const CLI::Option* readout = nullptr;
  std::vector<const CLI::Option*> bag_only;
};

std::string flightList() {
  std::ostringstream list;
  for (const auto& flight : flights()) {
    list << std::left << std::setw(16) << flight.name << flight.summary << " (" << flight.duration_s
         << " s; " << flight.world << ")\n";
  }
  return list.str();
}

std::vector<std::string> flightNames() {
  std::vector<std::string> names;
  for (const auto& flight : flights()) names.push_back(flight.name);
  return names;
}

std::vector<std::string> cameraNames() {
  std::vector<std::string> names;
  for (const auto& camera : cameras()) names.push_back(camera.name);
  return names;
}

/// What there is to see, and how the camera sees it.
void addCameraOptions(CLI::App& app, Options& o) {
  const auto oneOf = [](const std::vector<std::string>& names) { return CLI::IsMember(names); };
  app.add_option("--world", o.world.world, "where; default: the flight's own (--list)")
      ->check(oneOf(worldNames()));
  app.add_option("--light", o.world.light,
                 "steady; moving: a lamp wanders about; fading: dark from 20 to 32 s, then dim; "
                 "default: the flight's own")
      ->check(oneOf(lightNames()));
  app.add_option("--camera", o.camera,
                 "front: 640x360 as its driver's calibration has it, 80 degrees across; "
                 "front_wide: the data sheet's 92 degrees; bottom: 320x240, 64 degrees")
      ->capture_default_str()
      ->check(oneOf(cameraNames()));
  o.shutter = app.add_option("--shutter", o.shutter_ms,
                             "how long a row is exposed [ms]: motion blur; default: 0, of "
                             "fast_blur 16")
                  ->check(CLI::Range(0.0, 1000.0));
  o.readout = app.add_option("--readout", o.readout_ms,
                             "how much later the last row is exposed than the first [ms]: rolling "
                             "shutter; default: 0, of fast_blur 25")
                  ->check(CLI::Range(0.0, 1000.0));
  app.add_option("--gain", o.gain, "of light and noise, or auto: to a mean grey of 110")
      ->capture_default_str();
  app.add_option("--image-noise", o.world.effects.noise_grey,
                 "deviation of the images' white noise at gain 1 [grey]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--artefacts", o.world.effects.quantiser,
                 "blocks of 4x4 pixels as H.264 leaves them at this QP, 1 to 51; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, kLargestQuantiser));
}

void addOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version",
                       std::string("make_world (ardrone_vslam) " ARDRONE_VSLAM_VERSION));
  app.add_flag_callback(
      "--list", [] { throw CLI::CallForVersion(flightList(), 0); },
      "the flights, with a line about each");
  app.add_option("flight", o.world.flight, "which flight")
      ->required()
      ->check(CLI::IsMember(flightNames()));
  app.add_option("--out", o.out, "FILE.bag, or else a folder to make")->required();
  app.add_flag("--force", o.force, "replace what is there");
  o.seconds = app.add_option("--seconds", o.world.duration_s,
                             "of flight; default: the whole of it (--list)")
                  ->check(CLI::Range(0.001, 1e6));
  app.add_option("--rate", o.world.rate_hz, "images a second")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1e3));
  app.add_option("--observer-profile", o.observer_profile,
                 "how the simulated odometry drifts: truth, wheel, drone, hover, harsh "
                 "(config/observer_profiles.yaml); default: drone in a bag, no odometry in a "
                 "folder. A,B@S: A, from second S on B; laps_then_hover hovers with `hover` unless "
                 "this says otherwise");
  app.add_option("--range-noise", o.world.range_noise_m,
                 "also write a range sensor's height above what is below, with this deviation "
                 "[m]: /range in a bag, range.txt in a folder")
      ->check(CLI::Range(0.0, 10.0));
  addSeed(app, "--seed", o.world.seed, "of the noise in odometry, ranges and images");
  addSeed(app, "--world-seed", o.world.world_seed, "of the world");
  app.add_option("--start", o.start,
                 "X,Y,YAW, where the flight begins [m, m, rad] in the room of 8 x 6 m whose middle "
                 "is 0,0; default: on the flight's path");
  addCameraOptions(app, o);
  auto* images = app.add_option("--compressed", o.images, "images in a bag");
  images->capture_default_str()->check(CLI::IsMember({"raw", "png", "jpeg"}));
  auto* compression = app.add_option("--compression", o.compression, "of the bag's chunks");
  compression->capture_default_str()->check(CLI::IsMember({"none", "lz4", "bz2"}));
  o.bag_only = {images, compression};
}

bool isBag(const std::string& path) {
  return std::filesystem::path(path).extension() == ".bag";
}

FlightStart parseStart(const std::string& text) {
  FlightStart start;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &start.x_m, &start.y_m, &start.yaw_rad, &rest) !=
      3) {
    throw UsageError("--start: '" + text + "' must be X,Y,YAW, for example 1,-0.5,1.57");
  }
  return start;
}

#ifdef ARDRONE_VSLAM_WITH_ROS
void writeWorldBag(WorldSequence& world, const Options& o, ProgressLine& progress) {
  using Format = BagWriteOptions::ImageFormat;
  using Compression = BagWriteOptions::Compression;
  BagWriteOptions write;
  write.image_format = o.images == "png"    ? Format::kPng
                       : o.images == "jpeg" ? Format::kJpeg
                                            : Format::kRaw;
  write.compression = o.compression == "lz4"   ? Compression::kLz4
                      : o.compression == "bz2" ? Compression::kBz2
                                               : Compression::kNone;
  write.observer_profile = o.world.observer;
  write.seed = o.world.seed;
  write.tool = "make_world (ardrone_vslam) " ARDRONE_VSLAM_VERSION ", flight " + o.world.flight +
               ", world seed " + std::to_string(o.world.world_seed);
  write.progress = [&progress](std::size_t done, std::size_t) { progress.update(done); };
  writeBag(world, write, o.out);
}
#else
void writeWorldBag(WorldSequence&, const Options& o, ProgressLine&) {
  throw std::runtime_error(o.out +
                           ": this make_world was built without ROS and cannot write bags; name a "
                           "folder, or build with ROS (scripts/install_dependencies)");
}
#endif

/// Only a folder as make_world makes it: --force must not empty anything else.
void removeOldFolder(const std::string& path) {
  namespace fs = std::filesystem;
  if (!fs::exists(path)) return;
  if (!fs::is_directory(path + "/image") || !fs::exists(path + "/times.txt")) {
    throw std::runtime_error(path + ": is no folder of images (image/, times.txt) that --force " +
                             "could replace; remove it yourself or choose another name");
  }
  fs::remove_all(path);
}

void writeWorldFolder(WorldSequence& world, const Options& o, ProgressLine& progress) {
  TumFolderOptions write;
  if (o.world.observer) {
    write.observer_comment = "profile " + o.world.observer->name + ", seed " +
                             std::to_string(o.world.seed) + ", drawn scale error " +
                             std::to_string(world.observerNote().scale_error);
  }
  write.progress = [&progress](std::size_t done, std::size_t) { progress.update(done); };
  if (o.force) removeOldFolder(o.out);
  writeTumFolder(world, o.out, write);
}

void refuseBagOptions(const Options& o) {
  for (const CLI::Option* option : o.bag_only) {
    if (option->count() == 0) continue;
    throw UsageError("--out " + o.out + ": is a folder (a bag's name ends in .bag), and " +
                     option->get_name() + " is for bags only; leave it out, or give --out " +
                     o.out + ".bag");
  }
}

/// A drone that hovers has no help from its motion: its odometry drifts as `hover` does.
void fitToHover(double begin_s, Options& o) {
  if (o.observer_profile.empty() || o.observer_profile.find(',') != std::string::npos) return;
  std::array<char, 40> later{};
  std::snprintf(later.data(), later.size(), ",hover@%g", begin_s);
  o.observer_profile += later.data();
}

std::optional<double> parseGain(const std::string& text) {
  if (text == "auto") return std::nullopt;
  double gain = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf%c", &gain, &rest) != 1 || !(gain > 0) || !(gain <= 100)) {
    throw UsageError("--gain: '" + text + "' must be a number above 0 and up to 100, or auto");
  }
  return gain;
}

/// What the flight and the camera decide where nothing else was asked for.
void fitToFlight(bool bag, Options& o) {
  const FlightInfo& flight = flightInfo(o.world.flight);
  if (o.seconds->count() == 0) o.world.duration_s = flight.duration_s;
  CameraEffects& effects = o.world.effects;
  effects.shutter_s = o.shutter->count() == 0 ? flight.shutter_s : o.shutter_ms / 1000;
  effects.readout_s = o.readout->count() == 0 ? flight.readout_s : o.readout_ms / 1000;
  effects.gain = parseGain(o.gain);
  const CameraChoice& camera = cameraNamed(o.camera);
  o.world.camera = camera.intrinsics;
  o.world.T_body_cam = camera.T_body_cam;
  // Base of a folder is by its definition where the camera is and looks along it.
  o.world.T_base_cam = bag ? camera.T_body_cam : forwardCamera();
  if (!bag && o.camera == "bottom" && o.world.range_noise_m) {
    throw UsageError(
        "--range-noise: the base of a folder looks along its camera, so the bottom "
        "camera's has no heights; write a bag");
  }
}

int run(Options& o) {
  const bool bag = isBag(o.out);
  if (!bag) refuseBagOptions(o);
  fitToFlight(bag, o);
  if (!o.force && std::filesystem::exists(o.out)) {
    throw std::runtime_error(o.out + ": is there already; choose another name or give --force");
  }
  if (bag && o.observer_profile.empty()) o.observer_profile = "drone";
  if (const auto begin_s = hoverBegin_s(o.world.flight)) fitToHover(*begin_s, o);
  if (!o.observer_profile.empty()) o.world.observer = profileOfOption(o.observer_profile);
  if (!o.start.empty()) o.world.start = parseStart(o.start);
  auto world_pointer = asUsage([&o] { return std::make_unique<WorldSequence>(o.world); });
  WorldSequence& world = *world_pointer;
  {
    ProgressLine progress("make_world", world.size());
    bag ? writeWorldBag(world, o, progress) : writeWorldFolder(world, o, progress);
  }
  std::cout << o.out << ": " << world.size() << " images, world seed " << o.world.world_seed;
  if (o.world.observer) {
    std::cout << "; observer profile " << o.world.observer->name << ", seed " << o.world.seed
              << ", scale error " << world.observerNote().scale_error;
  }
  std::cout << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Renders a flight of an AR.Drone through a synthetic world: images, exact truth, odometry.",
      "make_world"};
  Options options;
  addOptions(app, options);
  return runTool(app, argc, argv, [&options] { return run(options); });
}
