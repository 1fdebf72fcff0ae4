// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/collection/doctor_live.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "bags/messages/bag_messages.hpp"
#include "bags/messages/grey_image.hpp"
#include "doctor/camera/doctor_tracks.hpp"
#include "doctor/collection/doctor_collector.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kTick_s = 0.1;
constexpr std::uint32_t kQueue = 400;

std::int64_t now_ns() {
  return toNanoseconds(ros::Time::now());
}

/// Subscribes what was chosen; its callbacks run in the caller's thread.
class Listener {
 public:
  explicit Listener(DoctorRecording& recording)
      : recording_(recording),
        collector_(recording),
        pixels_(std::make_shared<std::vector<cv::Mat>>()) {
    const auto pixels = pixels_;
    recording.grey = [pixels](std::size_t image) {
      return image < pixels->size() ? (*pixels)[image] : cv::Mat();
    };
    subscribe("/tf", &Listener::takeTf);
    subscribe("/tf_static", &Listener::takeTf);
    if (isCompressed(recording)) {
      subscribe(recording.image_topic, &Listener::takePacked);
    } else {
      subscribe(recording.image_topic, &Listener::takeRaw);
    }
    subscribe(recording.camera_info_topic, &Listener::take<sensor_msgs::CameraInfo>);
    subscribe(recording.odometry_topic, &Listener::take<nav_msgs::Odometry>);
    subscribe(recording.navdata_topic, &Listener::take<Navdata>);
    subscribe(recording.imu_topic, &Listener::take<sensor_msgs::Imu>);
  }

 private:
  template <class Message>
  void subscribe(const std::string& topic,
                 void (Listener::*callback)(const boost::shared_ptr<const Message>&)) {
    if (topic.empty()) return;
    subscribers_.push_back(nh_.subscribe<Message>(topic, kQueue, callback, this));
  }
  template <class Message>
  void take(const boost::shared_ptr<const Message>& message) {
    collector_.see(*message, now_ns());
  }
  void takeTf(const tf2_msgs::TFMessage::ConstPtr& message) { collector_.see(*message); }
  void takeRaw(const sensor_msgs::Image::ConstPtr& message) {
    collector_.see(*message, now_ns());
    const bool is_usable = recording_.images.back().fault.empty();
    keep(is_usable ? greyImage(*message) : cv::Mat());
  }
  void takePacked(const sensor_msgs::CompressedImage::ConstPtr& message) {
    const cv::Mat grey = greyImage(*message);
    collector_.see(*message, grey.size(), now_ns());
    keep(grey);
  }
  void keep(const cv::Mat& grey) {
    pixels_->push_back(pixels_->size() < kMostTrackedImages ? grey : cv::Mat());
  }

  DoctorRecording& recording_;
  DoctorCollector collector_;
  std::shared_ptr<std::vector<cv::Mat>> pixels_;
  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace

DoctorRecording listen(const DoctorTopicNames& names, double seconds,
                       const std::function<void(std::size_t tenths)>& progress) {
  if (!ros::master::check()) {
    throw std::runtime_error("no ROS master at " + ros::master::getURI() +
                             ": start the driver (or roscore) first, and check ROS_MASTER_URI");
  }
  DoctorRecording recording;
  recording.name = "live";
  recording.is_live = true;
  ros::master::V_TopicInfo published;
  ros::master::getTopics(published);
  for (const ros::master::TopicInfo& topic : published) {
    recording.topics[topic.name] = {topic.datatype, 0};
  }
  chooseTopics(names, recording);
  const Listener listener(recording);
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  const ros::WallTime begin = ros::WallTime::now();
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kTick_s));
    const double passed_s = (ros::WallTime::now() - begin).toSec();
    if (progress) progress(static_cast<std::size_t>(passed_s / kTick_s));
  }
  return recording;
}

}  // namespace ardrone_vslam
