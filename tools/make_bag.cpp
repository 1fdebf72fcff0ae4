// SPDX-License-Identifier: BSD-3-Clause
// make_bag: a folder of images or a recorded video stream of the AR.Drone as a bag.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>

#include "bags/bag_writer.hpp"
#include "folders/kitti_folder.hpp"
#include "folders/tum_folder.hpp"
#include "pave/pave_sequence.hpp"
#include "program/profile_option.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"

namespace {

using namespace ardrone_vslam;

struct Options {
  std::string input;
  std::string out;
  bool force = false;
  std::string odometry_profile;
  std::string frames;
  bool ping_pong = false;
  std::string images = "raw";
  std::string compression = "none";
  PaveOptions pave;
  BagWriteOptions write;
};

using Write = BagWriteOptions;

const std::map<std::string, Write::ImageFormat> kFormats{{"raw", Write::ImageFormat::kRaw},
                                                         {"png", Write::ImageFormat::kPng},
                                                         {"jpeg", Write::ImageFormat::kJpeg}};
const std::map<std::string, Write::Compression> kCompressions{{"none", Write::Compression::kNone},
                                                              {"lz4", Write::Compression::kLz4},
                                                              {"bz2", Write::Compression::kBz2}};

void addNames(CLI::App& command, Options& o) {
  const std::string group = "Names";
  const auto add = [&](const std::string& name, std::string& value, const std::string& what) {
    command.add_option(name, value, what)->capture_default_str()->group(group);
  };
  add("--image-topic", o.write.topics.image, "compressed images go to it + /compressed");
  add("--camera-info-topic", o.write.topics.camera_info, "calibration");
  add("--odometry-topic", o.write.topics.odometry, "the simulated or recorded odometry");
  add("--truth-topic", o.write.topics.truth, "true poses of the base frame");
  add("--map-frame", o.write.frames.map, "of the truth");
  add("--odom-frame", o.write.frames.odom, "of the odometry");
  add("--base-frame", o.write.frames.base, "of the drone's body");
  add("--camera-frame", o.write.frames.camera, "of the camera, optical axes");
}

void addCommon(CLI::App& command, Options& o) {
  command.add_option("--out", o.out, "the bag to write, FILE.bag")->required();
  command.add_flag("--force", o.force, "overwrite the bag if it is there");
  command.add_option("--odometry-profile", o.odometry_profile,
                     "how the simulated odometry drifts: truth, wheel, wheels, drone, hover, harsh "
                     "(config/odometry_profiles.yaml); default: the recorded odometry if there is "
                     "one, else wheel for kitti, drone for the others");
  addSeed(command, "--seed", o.write.seed, "of the odometry's noise");
  command.add_option("--compressed", o.images, "images in the bag")
      ->capture_default_str()
      ->check(CLI::IsMember({"raw", "png", "jpeg"}));
  command.add_option("--compression", o.compression, "of the bag's chunks")
      ->capture_default_str()
      ->check(CLI::IsMember({"none", "lz4", "bz2"}));
  command.add_option("--frames", o.frames, "A:B:STEP, frames A up to but without B");
  command.add_flag("--ping-pong", o.ping_pong, "even frames forward, then odd frames backward");
  addNames(command, o);
}

std::unique_ptr<Sequence> openSource(const CLI::App& app, const Options& o) {
  if (app.got_subcommand("kitti")) return openKittiFolder(o.input);
  if (app.got_subcommand("tum")) return openTumFolder(o.input);
  auto pave = openPave(o.input, o.pave);
  for (const auto& warning : pave->warnings()) {
    std::cerr << "make_bag: warning: " << o.input << ": " << warning << '\n';
  }
  return pave;
}

bool neverMoves(const Trajectory& truth) {
  constexpr double kRest_m = 1e-6;
  return truth.size() > 1 &&
         std::all_of(truth.poses().begin(), truth.poses().end(), [&](const StampedPose& pose) {
           const Eigen::Vector3d& start = truth.poses().front().T_frame_body.translation();
           return (pose.T_frame_body.translation() - start).norm() < kRest_m;
         });
}

/// @param advice  what to do when there is neither truth nor odometry
void chooseOdometry(const Sequence& sequence, const std::string& advice, Options& o) {
  std::string name = o.odometry_profile;
  if (name.empty() && sequence.odometry().empty() && !sequence.truth().empty()) {
    name = defaultProfile(o.input);
  }
  if (!o.pave.at_rest && neverMoves(sequence.truth())) {
    std::cerr << "make_bag: warning: " << sequence.name()
              << ": all true poses are at the same place; check poses.txt or poses_tum.txt\n";
  }
  if (!name.empty()) {
    o.write.odometry_profile = profileOfOption(name);
  } else if (sequence.odometry().empty()) {
    std::cerr << "make_bag: warning: " << sequence.name()
              << ": has neither true poses nor odometry; the bag gets no odometry" << advice
              << '\n';
  }
}

const char* const kAtRestAdvice = "; if the drone stood still, give --at-rest";

/// @throws UsageError
void checkUsage(const CLI::App& app, const Options& o) {
  if (std::filesystem::path(o.out).extension() != ".bag") {
    throw UsageError("--out " + o.out + ": the name of a bag ends in .bag; give --out " + o.out +
                     ".bag");
  }
  if (app.got_subcommand("pave") && !o.pave.at_rest && !o.odometry_profile.empty()) {
    throw UsageError(o.input + ": --odometry-profile " + o.odometry_profile +
                     " needs true poses, and a video stream has none" + kAtRestAdvice +
                     ", else leave the profile out");
  }
}

int run(const CLI::App& app, Options& o) {
  checkUsage(app, o);
  if (!o.odometry_profile.empty()) profileOfOption(o.odometry_profile);
  o.write.image_format = kFormats.at(o.images);
  o.write.compression = kCompressions.at(o.compression);
  const FrameSelection selection =
      asUsage([&o] { return FrameSelection::parse(o.frames, o.ping_pong); });
  if (!o.force && std::filesystem::exists(o.out)) {
    throw std::runtime_error(o.out + ": is there already; choose another name or give --force");
  }
  const auto sequence = select(openSource(app, o), selection);
  chooseOdometry(*sequence, app.got_subcommand("pave") ? kAtRestAdvice : "", o);
  o.write.tool = "make_bag (ardrone_vslam) " ARDRONE_VSLAM_VERSION;
  BagWriteReport report;
  {
    ProgressLine progress("make_bag", sequence->size());
    o.write.progress = [&progress](std::size_t done, std::size_t) { progress.update(done); };
    report = writeBag(*sequence, o.write, o.out);
  }
  std::cout << o.out << ": " << report.images << " images, " << report.odometry
            << " odometry messages, " << report.truth << " true poses, "
            << std::filesystem::file_size(o.out) / 1024 << " KiB\n";
  if (o.write.odometry_profile) {
    std::cout << "odometry profile " << o.write.odometry_profile->name << ", seed " << o.write.seed
              << ", scale error " << report.scale_error << '\n';
  }
  if (report.stamp_offset_ns != 0) {
    std::cout << "stamps moved by " << report.stamp_offset_ns / 1'000'000'000
              << " s, as ROS has no time 0\n";
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes recorded images as a bag with camera_info, odometry, tf and the truth.",
               "make_bag"};
  app.set_version_flag("--version", std::string("make_bag (ardrone_vslam) " ARDRONE_VSLAM_VERSION));
  app.require_subcommand(1);
  Options o;
  auto* kitti = app.add_subcommand("kitti", "a folder of the KITTI odometry data");
  auto* tum = app.add_subcommand("tum", "a folder with image/, camera.yaml, times.txt");
  auto* pave = app.add_subcommand("pave", "a recorded stream of the AR.Drone 2.0's video port");
  for (CLI::App* command : {kitti, tum, pave}) {
    command->add_option("input", o.input, command->get_description())->required();
    addCommon(*command, o);
  }
  pave->add_option("--camera", o.pave.camera_yaml,
                   "calibration; default: camera.yaml beside the stream");
  pave->add_option("--bottom-camera", o.pave.bottom_camera_yaml,
                   "calibration of the bottom camera, when its pictures have another size");
  pave->add_flag("--at-rest", o.pave.at_rest, "the drone stood still: its true pose is known");
  return runTool(app, argc, argv, [&] { return run(app, o); });
}
