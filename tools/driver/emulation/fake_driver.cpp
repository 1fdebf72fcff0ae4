// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/fake_driver.hpp"

#include <opencv2/core/utility.hpp>

#include "bags/messages/bag_messages.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kCameraTfSteps = 20;  // 10 Hz

bool has(const DriverFaults& faults, DriverFault fault) {
  return faults.count(fault) > 0;
}

}  // namespace

FakeDriver::FakeDriver(const ros::NodeHandle& nh, const FakeDriverConfig& config)
    : faults_(faultsOf(config)),
      drone_(worldOf(config), droneOf(config)),
      driver_(faults_, prefixOf(config, faults_)),
      link_(!has(faults_, DriverFault::kBursts), static_cast<std::uint64_t>(config.seed)),
      video_(drone_.world(), link_, config),
      autopilot_(config, faults_),
      topics_(nh, prefixOf(config, faults_), has(faults_, DriverFault::kUnscaledCameraInfo)),
      commands_(nh, mutex_, drone_, driver_, video_) {
  cv::setNumThreads(1);  // the other cores are the nodelets'
  diagnostics_.setHardwareID("fake AR.Drone");
  diagnostics_.add("drone and its video",
                   [this](diagnostic_updater::DiagnosticStatusWrapper& s) { diagnose(s); });
}

void FakeDriver::run() {
  pace_.begin(toNanoseconds(ros::Time::now()));
  while (ros::ok()) step(pace_.await());
}

void FakeDriver::step(std::int64_t now_ns) {
  autopilot_.beginWhenWatched(now_ns, topics_, drone_);
  DroneMoment moment;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    moment = drone_.advance();
    autopilot_.strikeOnTime(moment.t_s, driver_, video_);
    held_.push_back(moment.packet);
    if (!link_.holdsPacket()) receivePackets(now_ns);
    video_.expose(moment, now_ns, pace_.sinceBegin_ns(), topics_);
  }
  // Its map's origin is where it was switched on.
  topics_.publishTruth(Eigen::Translation3d(-drone_.start_m()) * moment.state.T_world_body, now_ns);
  if (pace_.step() % kCameraTfSteps == 0) topics_.sendTransforms(driver_.cameraTransforms(now_ns));
  video_.publishArrived(now_ns, topics_);
  diagnostics_.update();
}

void FakeDriver::receivePackets(std::int64_t now_ns) {
  for (const DronePacket& packet : held_) topics_.publish(driver_.receive(packet, now_ns));
  held_.clear();
}

void FakeDriver::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  video_.diagnose(status);
  status.add("milliseconds that a packet was late at worst", 1000 * pace_.takeLatest_s());
  status.add("faults", nameList(faults_));
}

}  // namespace ardrone_vslam
