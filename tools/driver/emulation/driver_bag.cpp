// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/driver_bag.hpp"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/image_encodings.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "bags/messages/bag_messages.hpp"
#include "driver/driver_link.hpp"
#include "driver/drone_flight.hpp"
#include "driver/emulation/driver_emulation.hpp"
#include "driver/emulation/driver_video.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kCameraTfStep_ns = 100'000'000;

/// Something to record, in the order of time.
struct Event {
  enum class Kind { kCameraTf, kTruth, kPacket, kImage };
  std::int64_t stamp_ns;
  Kind kind;
  std::size_t index;
};

std::string prefixOf(const DriverBagOptions& options) {
  const bool needs_one = options.faults.count(DriverFault::kUnprefixedFrame) > 0;
  return options.tf_prefix.empty() && needs_one ? kDefaultTfPrefix : options.tf_prefix;
}

class DriverBagWriter {
 public:
  DriverBagWriter(const WorldSequence& world, const DriverBagOptions& options, rosbag::Bag& bag)
      : world_(world),
        options_(options),
        bag_(bag),
        duration_s_(static_cast<double>(world.size()) / world.options().rate_hz),
        drone_(flyDrone(world.flight(), world.world(), duration_s_, kDriverBagBegin_ns,
                        options.profile, world.options().seed)),
        driver_(options.faults, prefixOf(options)) {}

  void writeAll() {
    writeInfo();
    for (const Event& event : events()) {
      switch (event.kind) {
        case Event::Kind::kCameraTf:
          writeTf(event.stamp_ns, driver_.cameraTransforms(event.stamp_ns));
          break;
        case Event::Kind::kTruth:
          writeTruth(drone_.truth.poses()[event.index]);
          break;
        case Event::Kind::kPacket:
          writePacket(event.index, event.stamp_ns);
          break;
        case Event::Kind::kImage:
          writeImage(event.index, event.stamp_ns);
          break;
      }
    }
  }

 private:
  bool has(DriverFault fault) const { return options_.faults.count(fault) > 0; }
  double imageTime_s(std::size_t index) const {
    return static_cast<double>(index) / world_.options().rate_hz;
  }

  std::vector<Event> events() const {
    std::vector<Event> events;
    DriverLink link(!has(DriverFault::kBursts), world_.options().seed);
    const auto& poses = drone_.truth.poses();
    const std::int64_t end_ns = poses.back().stamp_ns;
    for (std::int64_t tf_ns = kDriverBagBegin_ns; tf_ns <= end_ns; tf_ns += kCameraTfStep_ns) {
      events.push_back({tf_ns, Event::Kind::kCameraTf, 0});
    }
    std::size_t held = 0;  // first packet not yet received
    for (std::size_t i = 0; i < poses.size(); ++i) {
      events.push_back({poses[i].stamp_ns, Event::Kind::kTruth, i});
      if (link.holdsPacket() && i + 1 < poses.size()) continue;
      for (; held <= i; ++held) {
        events.push_back({poses[i].stamp_ns, Event::Kind::kPacket, held});
      }
    }
    for (std::size_t i = 0; i < world_.size(); ++i) {
      const std::int64_t exposed_ns = kDriverBagBegin_ns + std::llround(imageTime_s(i) * 1e9);
      events.push_back({exposed_ns + link.videoDelay_ns(), Event::Kind::kImage, i});
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.stamp_ns < b.stamp_ns; });
    return events;
  }

  void writeInfo() {
    YAML::Emitter yaml;
    yaml << YAML::BeginMap << YAML::Key << "tool" << YAML::Value << options_.tool;
    yaml << YAML::Key << "source" << YAML::Value << world_.name();
    yaml << YAML::Key << "odometry_profile" << YAML::Value << options_.profile.name;
    yaml << YAML::Key << "seed" << YAML::Value << world_.options().seed;
    yaml << YAML::Key << "scale_error" << YAML::Value << drone_.scale_error;
    yaml << YAML::Key << "driver_faults" << YAML::Value << nameList(options_.faults);
    yaml << YAML::EndMap;
    std_msgs::String text;
    text.data = yaml.c_str();
    bag_.write(BagTopicNames().info, toRosTime(kDriverBagBegin_ns), text, latchedHeader(text));
  }

  /// The driver sends each transform by itself.
  void writeTf(std::int64_t stamp_ns,
               const std::vector<geometry_msgs::TransformStamped>& transforms) {
    for (const auto& transform : transforms) {
      tf2_msgs::TFMessage tf;
      tf.transforms = {transform};
      bag_.write("/tf", toRosTime(stamp_ns), tf);
    }
  }

  void writeTruth(const StampedPose& pose) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = toRosTime(pose.stamp_ns);
    message.header.frame_id = BagFrameNames().map;
    message.pose = toPose(pose.T_frame_body);
    bag_.write(BagTopicNames().truth, message.header.stamp, message);
  }

  void writePacket(std::size_t index, std::int64_t stamp_ns) {
    if (has(DriverFault::kEpochDt) && index == drone_.packets.size() / 2) driver_.restart();
    const DriverMessages messages = driver_.receive(drone_.packets[index], stamp_ns);
    const ros::Time stamp = toRosTime(stamp_ns);
    bag_.write("/ardrone/mag", stamp, messages.mag);
    bag_.write("/ardrone/navdata", stamp, messages.navdata);
    bag_.write("/ardrone/imu", stamp, messages.imu);
    bag_.write("/ardrone/odometry", stamp, messages.odometry);
    writeTf(stamp_ns, {messages.T_odom_base});
  }

  const CameraChoice& activeCamera(double t_s) const {
    const CameraChoice& chosen = cameraNamed(options_.camera);
    const bool is_middle = t_s >= duration_s_ / 3 && t_s < duration_s_ * 2 / 3;
    if (!has(DriverFault::kTogglecam) || !is_middle) return chosen;
    return cameraNamed(chosen.name == "bottom" ? "front" : "bottom");
  }

  cv::Mat shoot(const CameraChoice& camera, std::size_t index) {
    const double t_s = imageTime_s(index);
    const auto motion = [&](double since_stamp_s) {
      return world_.flight().pose(t_s + since_stamp_s) * camera.T_body_cam;
    };
    const auto lens =
        lenses_.try_emplace(camera.name, camera.intrinsics, world_.options().effects).first;
    // The noise that the sequence's own image has.
    return lens->second.shoot(world_.world().at(t_s), motion,
                              RandomSource::mix(world_.options().seed) + index);
  }

  void writeImage(std::size_t index, std::int64_t stamp_ns) {
    const CameraChoice& camera = activeCamera(imageTime_s(index));
    const bool is_bottom = camera.name == "bottom";
    std_msgs::Header header;
    header.stamp = toRosTime(stamp_ns);
    header.frame_id = is_bottom ? driver_.frames().bottom : driver_.frames().front;
    sensor_msgs::CameraInfo info =
        streamCameraInfo(camera.intrinsics, has(DriverFault::kUnscaledCameraInfo));
    info.header = header;
    const cv::Mat image = streamImage(shoot(camera, index));
    for (const std::string name : {"/ardrone", is_bottom ? "/ardrone/bottom" : "/ardrone/front"}) {
      bag_.write(name + "/camera_info", header.stamp, info);
      writePixels(name + "/image_raw", header, image);
    }
    if (options_.progress) options_.progress(index + 1);
  }

  void writePixels(const std::string& topic, const std_msgs::Header& header, const cv::Mat& image) {
    using Format = BagWriteOptions::ImageFormat;
    if (options_.image_format == Format::kRaw) {
      const cv_bridge::CvImage bridge(header, sensor_msgs::image_encodings::RGB8, image);
      bag_.write(topic, header.stamp, *bridge.toImageMsg());
      return;
    }
    bag_.write(topic + "/compressed", header.stamp,
               compressedImage(header, image, options_.image_format == Format::kPng));
  }

  const WorldSequence& world_;
  const DriverBagOptions& options_;
  rosbag::Bag& bag_;
  double duration_s_;
  DroneFlight drone_;
  DriverEmulation driver_;
  std::map<std::string, WorldCamera> lenses_;  // made when first needed
};

}  // namespace

void writeDriverBag(const WorldSequence& world, const DriverBagOptions& options,
                    const std::string& path) {
  writeBagFile(path, options.compression,
               [&](rosbag::Bag& bag) { DriverBagWriter(world, options, bag).writeAll(); });
}

}  // namespace ardrone_vslam
