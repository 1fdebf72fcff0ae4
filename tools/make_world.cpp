// SPDX-License-Identifier: BSD-3-Clause
// make_world: renders a flight through a synthetic world, as a bag or as a TUM-like folder.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#ifdef ARDRONE_VSLAM_WITH_ROS
#include "bags/bag_writer.hpp"
#include "driver/emulation/driver_bag.hpp"
#endif
#include "driver/driver_arguments.hpp"
#include "folders/tum_folder_writer.hpp"
#include "program/profile_option.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"
#include "world/world_arguments.hpp"
#include "world/world_sequence.hpp"

namespace {

using namespace ardrone_vslam;

struct Options {
  WorldOptions world;
  std::string out;
  bool force = false;
  std::string odometry_profile;
  std::string start;  // "X,Y,YAW" [m, m, rad]; empty: the flight's own
  std::string images = "raw";
  std::string compression = "none";
  CameraArguments camera;
  DriverArguments driver;
  const CLI::Option* seconds = nullptr;
  const CLI::Option* rate = nullptr;
  std::vector<const CLI::Option*> bag_only;
};

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
                  ->check(numberWithin(0.001, 1e6));
  o.rate = app.add_option("--rate", o.world.rate_hz, "images a second; default: 30, driver's 20")
               ->check(numberWithin(0.001, 1e3));
  app.add_option("--odometry-profile", o.odometry_profile,
                 "how the simulated odometry drifts: truth, wheel, wheels, drone, hover, harsh "
                 "(config/odometry_profiles.yaml); default: drone in a bag, no odometry in a "
                 "folder. A,B@S: A, from second S on B; laps_then_hover hovers with `hover` unless "
                 "this says otherwise");
  app.add_option("--range-noise", o.world.range_noise_m,
                 "also write a range sensor's height above what is below, with this deviation "
                 "[m]: /range in a bag, range.txt in a folder")
      ->check(numberWithin(0.0, 10.0));
  addSeed(app, "--seed", o.world.seed, "of the noise in odometry, ranges and images");
  addSeed(app, "--world-seed", o.world.world_seed, "of the world");
  app.add_option("--start", o.start,
                 "X,Y,YAW, where the flight begins [m, m, rad] in the room of 8 x 6 m whose middle "
                 "is 0,0; default: on the flight's path");
  addCameraOptions(app, o.world, o.camera);
  auto* images = app.add_option("--compressed", o.images, "images in a bag");
  images->capture_default_str()->check(CLI::IsMember({"raw", "png", "jpeg"}));
  auto* compression = app.add_option("--compression", o.compression, "of the bag's chunks");
  compression->capture_default_str()->check(CLI::IsMember({"none", "lz4", "bz2"}));
  addDriverOptions(app, o.driver);
  o.bag_only = {images, compression, o.driver.driver};
}

bool isBag(const std::string& path) {
  return std::filesystem::path(path).extension() == ".bag";
}

#ifdef ARDRONE_VSLAM_WITH_ROS
template <class WriteOptions>
void setFormat(const Options& o, WriteOptions& write) {
  using Format = BagWriteOptions::ImageFormat;
  write.image_format = o.images == "png"    ? Format::kPng
                       : o.images == "jpeg" ? Format::kJpeg
                                            : Format::kRaw;
  write.compression = o.compression == "lz4"   ? BagCompression::kLz4
                      : o.compression == "bz2" ? BagCompression::kBz2
                                               : BagCompression::kNone;
  write.tool = "make_world (ardrone_vslam) " ARDRONE_VSLAM_VERSION ", flight " + o.world.flight +
               ", world seed " + std::to_string(o.world.world_seed);
}

void writeWorldBag(WorldSequence& world, const Options& o, ProgressLine& progress) {
  if (o.driver.isChosen()) {
    DriverBagOptions write;
    setFormat(o, write);
    write.faults = o.driver.faults;
    write.tf_prefix = o.driver.tf_prefix;
    write.camera = o.camera.camera;
    write.profile = *o.world.odometry;
    write.progress = [&progress](std::size_t done) { progress.update(done); };
    writeDriverBag(world, write, o.out);
    return;
  }
  BagWriteOptions write;
  setFormat(o, write);
  write.odometry_profile = o.world.odometry;
  write.seed = o.world.seed;
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
  if (o.world.odometry) {
    write.odometry_comment = "profile " + o.world.odometry->name + ", seed " +
                             std::to_string(o.world.seed) + ", drawn scale error " +
                             std::to_string(world.odometryNote().scale_error);
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
  if (o.odometry_profile.empty() || o.odometry_profile.find(',') != std::string::npos) return;
  std::array<char, 40> later{};
  std::snprintf(later.data(), later.size(), ",hover@%g", begin_s);
  o.odometry_profile += later.data();
}

void tellWritten(const WorldSequence& world, const Options& o) {
  std::cout << o.out << ": " << world.size() << " images, world seed " << o.world.world_seed;
  if (o.world.odometry) {
    std::cout << "; odometry profile " << o.world.odometry->name << ", seed " << o.world.seed
              << ", scale error " << world.odometryNote().scale_error;
  }
  std::cout << '\n';
}

int run(Options& o) {
  const bool bag = isBag(o.out);
  if (!bag) refuseBagOptions(o);
  if (o.seconds->count() == 0) o.world.duration_s = flightInfo(o.world.flight).duration_s;
  setCamera(o.camera, o.world);
  resolveDriver(o.driver, o.world);
  if (o.driver.isChosen() && o.rate->count() == 0) o.world.rate_hz = kDriverImageRate_hz;
  // Base of a folder is by its definition where the camera is and looks along it.
  if (!bag) o.world.T_base_cam = forwardCamera();
  if (!bag && o.camera.camera == "bottom" && o.world.range_noise_m) {
    throw UsageError(
        "--range-noise: the base of a folder looks along its camera, so the bottom "
        "camera's has no heights; write a bag");
  }
  if (!o.force && std::filesystem::exists(o.out)) {
    throw std::runtime_error(o.out + ": is there already; choose another name or give --force");
  }
  if (bag && o.odometry_profile.empty()) o.odometry_profile = "drone";
  if (const auto begin_s = hoverBegin_s(o.world.flight)) fitToHover(*begin_s, o);
  if (!o.odometry_profile.empty()) o.world.odometry = profileOfOption(o.odometry_profile);
  if (!o.start.empty()) o.world.start = parseStart("--start", o.start);
  auto world_pointer = asUsage([&o] { return std::make_unique<WorldSequence>(o.world); });
  WorldSequence& world = *world_pointer;
  {
    ProgressLine progress("make_world", world.size());
    bag ? writeWorldBag(world, o, progress) : writeWorldFolder(world, o, progress);
  }
  tellWritten(world, o);
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
