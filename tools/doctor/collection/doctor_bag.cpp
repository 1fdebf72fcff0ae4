// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/collection/doctor_bag.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <memory>
#include <vector>

#include "bags/bag_topics.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/bag_open.hpp"
#include "bags/messages/bag_read_message.hpp"
#include "bags/messages/grey_image.hpp"
#include "doctor/collection/doctor_collector.hpp"

namespace ardrone_vslam {
namespace {

/// Outlives the recording's reader of images.
struct OpenBag {
  rosbag::Bag bag;
  std::vector<rosbag::MessageInstance> images;
};

cv::Mat greyOf(const rosbag::MessageInstance& instance) {
  if (const auto raw = readMessage<sensor_msgs::Image>(instance)) return greyImage(*raw);
  const auto compressed = readMessage<sensor_msgs::CompressedImage>(instance);
  return compressed ? greyImage(*compressed) : cv::Mat();
}

void collect(const rosbag::MessageInstance& instance, const DoctorRecording& recording,
             DoctorCollector& collector, OpenBag& open) {
  const std::int64_t received_ns = toNanoseconds(instance.getTime());
  const std::string& topic = instance.getTopic();
  if (topic == recording.image_topic) {
    if (const auto raw = readMessage<sensor_msgs::Image>(instance)) {
      collector.see(*raw, received_ns);
      open.images.push_back(instance);
    } else if (const auto packed = readMessage<sensor_msgs::CompressedImage>(instance)) {
      collector.see(*packed, greyImage(*packed).size(), received_ns);
      open.images.push_back(instance);
    }
  } else if (const auto info = topic == recording.camera_info_topic
                                   ? readMessage<sensor_msgs::CameraInfo>(instance)
                                   : nullptr) {
    collector.see(*info, received_ns);
  } else if (const auto odometry = topic == recording.odometry_topic
                                       ? readMessage<nav_msgs::Odometry>(instance)
                                       : nullptr) {
    collector.see(*odometry, received_ns);
  } else if (const auto tf = readMessage<tf2_msgs::TFMessage>(instance)) {
    collector.see(*tf);
  } else if (const auto navdata = readMessage<Navdata>(instance)) {
    collector.see(*navdata, received_ns);
  } else if (const auto imu = readMessage<sensor_msgs::Imu>(instance)) {
    collector.see(*imu, received_ns);
  }
}

}  // namespace

DoctorRecording readForDoctor(
    const std::string& path, const DoctorTopicNames& names,
    const std::function<void(std::size_t done, std::size_t all)>& progress) {
  DoctorRecording recording;
  recording.name = path;
  const auto open = std::make_shared<OpenBag>();
  namingTheBag(path, [&] {
    openForReading(open->bag, path);
    for (const auto& topic : topicTypes(open->bag)) {
      recording.topics[topic.first] = {
          topic.second, rosbag::View(open->bag, rosbag::TopicQuery(topic.first)).size()};
    }
    chooseTopics(names, recording);
    std::vector<std::string> topics{"/tf", "/tf_static"};
    for (const std::string& topic :
         {recording.image_topic, recording.camera_info_topic, recording.odometry_topic,
          recording.navdata_topic, recording.imu_topic}) {
      if (!topic.empty()) topics.push_back(topic);
    }
    DoctorCollector collector(recording);
    rosbag::View view(open->bag, rosbag::TopicQuery(topics));
    std::size_t done = 0;
    for (const rosbag::MessageInstance& instance : view) {
      collect(instance, recording, collector, *open);
      if (progress) progress(++done, view.size());
    }
  });
  recording.grey = [open, path](std::size_t image) {
    cv::Mat grey;
    namingTheBag(path, [&] { grey = greyOf(open->images.at(image)); });
    return grey;
  };
  return recording;
}

}  // namespace ardrone_vslam
