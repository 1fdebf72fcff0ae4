// SPDX-License-Identifier: BSD-3-Clause
// doctor: what a bag, or a running system, has that keeps the SLAM from working, and what to do.

#include <ros/ros.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "config_files/config_file.hpp"
#include "doctor/camera/doctor_tracks.hpp"
#include "doctor/collection/doctor_bag.hpp"
#include "doctor/collection/doctor_live.hpp"
#include "doctor/collection/running_configuration.hpp"
#include "doctor/doctor_examination.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"
#include "trajectory/text_file.hpp"
#include "with_ros/ros_start.hpp"

namespace {

using namespace ardrone_vslam;

struct Options {
  std::string input;
  bool live = false;
  double seconds = 20;
  const CLI::Option* seconds_option = nullptr;
  std::string json;
  std::string config;
  DoctorTopicNames topics;
};

void addOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", std::string("doctor (ardrone_vslam) " ARDRONE_VSLAM_VERSION));
  app.add_option("bag", o.input, "the bag to look at");
  app.add_flag("--live", o.live, "look at the running system's topics instead of a bag");
  o.seconds_option =
      app.add_option("--seconds", o.seconds, "with --live: for how long; fly and turn meanwhile")
          ->capture_default_str()
          ->check(numberWithin(1.0, 600.0));
  app.add_option("--json", o.json,
                 "also write what was found as JSON to this file; -: to stdout, "
                 "in place of the text");
  app.add_option("--config", o.config,
                 "configuration file, as replay's: what it answers is no warning; default with "
                 "--live: the running mapper's parameters");
  app.add_option("--image,--image-topic", o.topics.image,
                 "topic; default: the one with the most messages, with --live the shortest name");
  app.add_option("--camera-info,--camera-info-topic", o.topics.camera_info,
                 "topic; default: beside the images");
  app.add_option("--odometry,--odometry-topic", o.topics.odometry,
                 "topic; default: the one with the most messages, with --live the shortest name");
  app.add_option("--navdata,--navdata-topic", o.topics.navdata, "topic; default: the driver's");
  app.add_option("--imu,--imu-topic", o.topics.imu, "topic; default: beside navdata");
  app.footer(
      "Exit code: 0 when it can work (warnings allowed), 1 when it cannot or cannot be read, 2 for "
      "wrong usage.");
}

DoctorRecording record(const Options& o) {
  if (o.live) {
    ProgressLine progress("doctor: listening, tenths of a second",
                          static_cast<std::size_t>(std::lround(o.seconds * 10)));
    return listen(o.topics, o.seconds, [&progress](std::size_t done) { progress.update(done); });
  }
  std::unique_ptr<ProgressLine> progress;
  return readForDoctor(o.input, o.topics, [&progress](std::size_t done, std::size_t all) {
    if (!progress) progress = std::make_unique<ProgressLine>("doctor: messages", all);
    progress->update(done);
  });
}

/// @throws ConfigError as replay would
DoctorConfiguration configurationInForce(const Options& o) {
  if (o.config.empty()) return o.live ? runningConfiguration() : DoctorConfiguration{};
  loadConfig(o.config, {});
  return configurationOfFile(o.config);
}

int run(const Options& o) {
  if (o.live == !o.input.empty()) throw UsageError("give either a bag or --live");
  if (!o.live && o.seconds_option->count() > 0) throw UsageError("--seconds is for --live only");
  const DoctorConfiguration in_force = configurationInForce(o);  // wrong files are told at once
  const DoctorRecording recording = record(o);
  DoctorReport report;
  {
    ProgressLine progress("doctor: images tracked", imagesToTrack(recording.images.size()).size());
    report = examine(
        recording, [&progress](std::size_t done) { progress.update(done); }, in_force);
  }
  if (o.json != "-") std::cout << textOf(report);
  if (!o.json.empty()) {
    const std::string json = jsonOf(report).dump(2) + "\n";
    o.json == "-" ? static_cast<void>(std::cout << json) : writeText(o.json, json);
  }
  return report.canWork() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  // Takes ROS's own arguments (topic:=other) out; without them there is no name to look up.
  if (!startRos(argc, argv, "doctor", ros::init_options::AnonymousName)) return 2;
  CLI::App app{
      "Looks at a bag (or with --live at the running topics): stamps, rates, calibration, tf, the "
      "odometry's and the AR.Drone driver's known faults, and whether the camera looks where tf "
      "says; says what to do.",
      "doctor"};
  Options options;
  addOptions(app, options);
  return runTool(app, argc, argv, [&options] { return run(options); });
}
