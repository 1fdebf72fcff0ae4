// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/fake_driver.hpp"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/image_encodings.h>

#include <chrono>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <thread>

#include "bags/messages/bag_messages.hpp"
#include "driver/emulation/driver_video.hpp"

namespace ardrone_vslam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kStep_ns = 5'000'000;
static_assert(kStep_ns * 200 == 1'000'000'000 && kPacketRate_hz == 200, "a step is a packet's");
constexpr std::int64_t kCameraTfSteps = 20;             // 10 Hz
constexpr std::int64_t kWatchedFor_ns = 2'000'000'000;  // before an autopilot's flight begins
constexpr double kLongestStall_s = 0.5;
constexpr double kWarnPeriod_s = 5;

std::string mapFrame(const std::string& prefix) {
  return prefix.empty() ? "map" : prefix + "/map";
}

}  // namespace

const std::string FakeDriver::kBottom = "bottom";

FakeDriver::FakeDriver(ros::NodeHandle nh, const FakeDriverConfig& config)
    : nh_(nh),
      config_(config),
      faults_(faultsOf(config)),
      front_(cameraNamed(config.camera).name == kBottom ? "front" : config.camera),
      drone_(worldOf(config), droneOf(config)),
      driver_(faults_, prefixOf(config, faults_)),
      map_frame_(mapFrame(prefixOf(config, faults_))),
      is_bottom_(config.camera == kBottom),
      link_(!has(DriverFault::kBursts), static_cast<std::uint64_t>(config.seed)),
      camera_(drone_.world(), CameraEffects{}, {front_, kBottom}),
      flight_s_(hasAutopilot(config) ? flightInfo(config.autopilot).duration_s : 0),
      transport_(nh) {
  cv::setNumThreads(1);  // the other cores are the nodelets'
  advertise();
  listen();
  diagnostics_.setHardwareID("fake AR.Drone");
  diagnostics_.add("drone and its video",
                   [this](diagnostic_updater::DiagnosticStatusWrapper& s) { diagnose(s); });
}

void FakeDriver::advertise() {
  for (const std::string name : {"", "front/", "bottom/"}) {
    images_pub_[name] = transport_.advertiseCamera("ardrone/" + name + "image_raw", 10);
  }
  navdata_pub_ = nh_.advertise<Navdata>("ardrone/navdata", 200);
  imu_pub_ = nh_.advertise<sensor_msgs::Imu>("ardrone/imu", 200);
  mag_pub_ = nh_.advertise<geometry_msgs::Vector3Stamped>("ardrone/mag", 200);
  odometry_pub_ = nh_.advertise<nav_msgs::Odometry>("ardrone/odometry", 200);
  truth_pub_ = nh_.advertise<geometry_msgs::PoseStamped>("truth/pose", 200);
}

void FakeDriver::listen() {
  using Empty = std_msgs::Empty::ConstPtr;
  const auto listenTo = [this](const std::string& topic, std::string (FakeDrone::*obey)()) {
    subscribers_.push_back(
        nh_.subscribe<std_msgs::Empty>("ardrone/" + topic, 1, [this, obey](const Empty&) {
          const std::lock_guard<std::mutex> lock(mutex_);
          answer((drone_.*obey)());
        }));
  };
  listenTo("takeoff", &FakeDrone::takeOff);
  listenTo("land", &FakeDrone::land);
  listenTo("reset", &FakeDrone::reset);
  subscribers_.push_back(nh_.subscribe<geometry_msgs::Twist>(
      "cmd_vel", 100, [this](const geometry_msgs::Twist::ConstPtr& twist) { onCommand(*twist); }));

  using Request = std_srvs::Empty::Request;
  using Response = std_srvs::Empty::Response;
  const auto serve = [this](const std::string& name, auto action) {
    const boost::function<bool(Request&, Response&)> callback = [this, action](Request&,
                                                                               Response&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      action();
      return true;
    };
    services_.push_back(nh_.advertiseService(name, callback));
  };
  serve("ardrone/togglecam", [this] { selectCamera(!is_bottom_); });
  serve("ardrone/flattrim", [] {});  // its accelerometer has no bias to trim away
  serve("ardrone/restart_driver", [this] { driver_.restart(); });
  const boost::function<bool(CamSelect::Request&, CamSelect::Response&)> select =
      [this](CamSelect::Request& request, CamSelect::Response& response) {
        const std::lock_guard<std::mutex> lock(mutex_);
        selectCamera(request.channel % 2 == 1);
        response.result = true;
        return true;
      };
  services_.push_back(nh_.advertiseService("ardrone/setcamchannel", select));
}

void FakeDriver::answer(const std::string& refusal) const {
  if (!refusal.empty()) ROS_WARN_STREAM_THROTTLE(kWarnPeriod_s, refusal);
}

void FakeDriver::onCommand(const geometry_msgs::Twist& twist) {
  DroneCommand command{twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z};
  command.auto_hover = twist.angular.x == 0 && twist.angular.y == 0;
  for (const double part : {command.forward, command.left, command.up, command.turn_left}) {
    if (std::abs(part) > 1 && std::isfinite(part)) {
      ROS_WARN_STREAM_THROTTLE(kWarnPeriod_s,
                               "cmd_vel is beyond +-1 and cut, as it is no speed "
                               "but a share of the drone's limits");
    }
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  answer(drone_.command(command));
}

void FakeDriver::selectCamera(bool bottom) {
  if (bottom == is_bottom_) return;
  is_bottom_ = bottom;
  ROS_INFO_STREAM("the " << activeCamera() << " camera streams");
}

void FakeDriver::run() {
  begin_ns_ = toNanoseconds(ros::Time::now());
  auto begin = Clock::now();
  while (ros::ok()) {
    const auto due = begin + std::chrono::nanoseconds(steps_ * kStep_ns);
    std::this_thread::sleep_until(due);
    const double late_s = std::chrono::duration<double>(Clock::now() - due).count();
    if (late_s > kLongestStall_s) {
      ROS_WARN_STREAM("this computer stood still for " << late_s << " s; so did the drone");
      const std::int64_t lost_ns = std::llround(late_s * 1e9);
      begin += std::chrono::nanoseconds(lost_ns);
      begin_ns_ += lost_ns;
    }
    latest_s_ = std::max(latest_s_, late_s);
    step(begin_ns_ + steps_ * kStep_ns);
    ++steps_;
  }
}

void FakeDriver::step(std::int64_t now_ns) {
  beginFlightWhenWatched(now_ns);
  DroneMoment moment;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    moment = drone_.advance();
    strikeOnTime(moment.t_s);
    held_.push_back({moment.packet, now_ns});
    if (!link_.holdsPacket()) receivePackets(now_ns);
    exposeImages(moment, now_ns);
  }
  publishTruth(moment.state.T_world_body, now_ns);
  if (steps_ % kCameraTfSteps == 0) {
    for (const auto& transform : driver_.cameraTransforms(now_ns)) tf_.sendTransform(transform);
  }
  while (const auto shot = camera_.take(now_ns)) publishImage(*shot);
  diagnostics_.update();
}

/// So that whoever looks on sees the whole flight.
void FakeDriver::beginFlightWhenWatched(std::int64_t now_ns) {
  if (flight_s_ == 0 || (flight_from_ns_ != 0 && now_ns < flight_from_ns_)) return;
  if (flight_from_ns_ != 0) {
    drone_.beginFlight();
  } else if (isWatched()) {
    flight_from_ns_ = now_ns + kWatchedFor_ns;
  }
}

/// The faults that a flight has at a time, as in a bag: without autopilot they have services.
void FakeDriver::strikeOnTime(double t_s) {
  if (flight_s_ == 0) return;
  if (has(DriverFault::kEpochDt) && !restarted_ && t_s >= flight_s_ / 2) {
    driver_.restart();
    restarted_ = true;
  }
  if (has(DriverFault::kTogglecam)) {
    const bool is_middle = t_s >= flight_s_ / 3 && t_s < flight_s_ * 2 / 3;
    selectCamera((config_.camera == kBottom) != is_middle);
  }
}

void FakeDriver::receivePackets(std::int64_t now_ns) {
  for (const Held& held : held_) {
    const DriverMessages messages = driver_.receive(held.packet, now_ns);
    mag_pub_.publish(messages.mag);
    navdata_pub_.publish(messages.navdata);
    imu_pub_.publish(messages.imu);
    odometry_pub_.publish(messages.odometry);
    tf_.sendTransform(messages.T_odom_base);
  }
  held_.clear();
}

bool FakeDriver::isWatched() const {
  for (const auto& [name, publisher] : images_pub_) {
    if (publisher.getNumSubscribers() > 0) return true;
  }
  return false;
}

void FakeDriver::exposeImages(const DroneMoment& moment, std::int64_t now_ns) {
  const auto since_begin_s = static_cast<double>(now_ns - begin_ns_) * 1e-9;
  const double exposed_s = static_cast<double>(images_) / config_.rate;
  if (exposed_s > since_begin_s + 1e-9) return;
  const std::int64_t seed = images_++;
  const std::int64_t delay_ns = link_.videoDelay_ns();
  if (!isWatched()) return;
  // The exposure was up to a step ago.
  const double ago_s = since_begin_s - exposed_s;
  const CameraPath path = pathThrough(moment.state, cameraNamed(activeCamera()).T_body_cam);
  CameraShot shot;
  shot.camera = activeCamera();
  shot.stamp_ns = now_ns - std::llround(ago_s * 1e9) + delay_ns;
  shot.t_s = moment.t_s;
  shot.motion = [path, ago_s](double since_stamp_s) { return path(since_stamp_s - ago_s); };
  shot.seed = RandomSource::mix(static_cast<std::uint64_t>(config_.seed)) +
              static_cast<std::uint64_t>(seed);
  camera_.shoot(std::move(shot));
}

void FakeDriver::publishTruth(const Eigen::Isometry3d& T_world_base, std::int64_t stamp_ns) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = toRosTime(stamp_ns);
  message.header.frame_id = map_frame_;
  message.pose = toPoseMessage(Eigen::Translation3d(-drone_.start_m()) * T_world_base);
  truth_pub_.publish(message);
}

void FakeDriver::publishImage(const CameraShot& shot) {
  const bool is_bottom = shot.camera == kBottom;
  std_msgs::Header header;
  header.stamp = toRosTime(shot.stamp_ns);
  header.frame_id = is_bottom ? driver_.frames().bottom : driver_.frames().front;
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(
      streamCameraInfo(cameraNamed(shot.camera).intrinsics, has(DriverFault::kUnscaledCameraInfo)));
  info->header = header;
  const sensor_msgs::ImagePtr image =
      cv_bridge::CvImage(header, sensor_msgs::image_encodings::RGB8, streamImage(shot.image))
          .toImageMsg();
  for (const std::string name : {"", is_bottom ? "bottom/" : "front/"}) {
    images_pub_[name].publish(image, info);
  }
}

void FakeDriver::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const LiveCamera::Counts counts = camera_.counts();
  if (counts.lost > lost_before_) {
    status.summary(DiagnosticStatus::WARN,
                   "this computer is too slow to render all images: lower rate, or shutter");
    ROS_WARN_STREAM_THROTTLE(kWarnPeriod_s,
                             counts.lost << " images were not rendered in time and are left out ("
                                         << counts.rendered << " were): lower rate, or shutter");
  } else {
    status.summary(DiagnosticStatus::OK, "in time");
  }
  status.add("images rendered", counts.rendered);
  status.add("images not rendered in time", counts.lost);
  status.add("milliseconds for the latest image", counts.render_ms);
  status.add("milliseconds that a packet was late at worst", 1000 * latest_s_);
  status.add("faults", nameList(faults_));
  lost_before_ = counts.lost;
  latest_s_ = 0;
}

}  // namespace ardrone_vslam
