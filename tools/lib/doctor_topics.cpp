// SPDX-License-Identifier: BSD-3-Clause
#include "doctor_topics.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

namespace ardrone_vslam {
namespace {

const char* const kImage = "sensor_msgs/Image";
const char* const kCompressed = "sensor_msgs/CompressedImage";
const char* const kCameraInfo = "sensor_msgs/CameraInfo";
const char* const kOdometry = "nav_msgs/Odometry";

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string parentName(const std::string& topic) {
  const auto slash = topic.rfind('/');
  return slash == std::string::npos ? std::string() : topic.substr(0, slash);
}

bool isOneOf(const std::vector<std::string>& types, const std::string& type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

std::string named(const DoctorRecording& recording, const std::string& name,
                  const std::vector<std::string>& types) {
  auto topic = recording.topics.find(name);
  if (topic == recording.topics.end()) topic = recording.topics.find("/" + name);
  std::string there;
  for (const auto& other : recording.topics) {
    there += (there.empty() ? "" : ", ") + other.first + " (" + other.second.type + ")";
  }
  if (topic == recording.topics.end()) {
    throw std::runtime_error(recording.name + ": has no topic " + name + "; there are: " + there);
  }
  if (!isOneOf(types, topic->second.type)) {
    throw std::runtime_error(recording.name + ": " + topic->first + " is " + topic->second.type +
                             ", not " + types.front() + "; there are: " + there);
  }
  return topic->first;
}

std::string best(DoctorRecording& recording, const std::string& name,
                 const std::vector<std::string>& types,
                 const std::function<bool(const std::string&)>& is_candidate) {
  if (!name.empty()) return named(recording, name, types);
  std::string best_name;
  std::size_t most = 0, candidates = 0;
  for (const auto& topic : recording.topics) {
    if (!isOneOf(types, topic.second.type) || !is_candidate(topic.first)) continue;
    ++candidates;
    const std::size_t messages = topic.second.messages;
    const bool is_better = best_name.empty() || messages > most ||
                           (messages == most && topic.first.size() < best_name.size());
    if (!is_better) continue;
    best_name = topic.first;
    most = messages;
  }
  if (candidates > 1) {
    recording.choices.push_back(best_name + " is one of " + std::to_string(candidates) +
                                " that fit");
  }
  return best_name;
}

}  // namespace

void chooseTopics(const DoctorTopicNames& names, DoctorRecording& recording) {
  const auto& topics = recording.topics;
  recording.image_topic =
      best(recording, names.image, {kImage, kCompressed}, [&topics](const std::string& topic) {
        const bool is_second =
            topics.at(topic).type == kCompressed && topics.count(parentName(topic)) > 0;
        return !is_second && !endsWith(topic, "/compressedDepth") &&
               !endsWith(topic, "/debug_image");
      });
  const std::string raw =
      isCompressed(recording) ? parentName(recording.image_topic) : recording.image_topic;
  const std::string beside = parentName(raw) + "/camera_info";
  const auto info = topics.find(beside);
  const bool is_beside = info != topics.end() && info->second.type == kCameraInfo;
  recording.camera_info_topic =
      best(recording, names.camera_info.empty() && is_beside ? beside : names.camera_info,
           {kCameraInfo}, [](const std::string&) { return true; });
  recording.odometry_topic =
      best(recording, names.odometry, {kOdometry}, [](const std::string& topic) {
        // What the mapper publishes is no observer, nor is the truth.
        return topic.find("truth") == std::string::npos && !endsWith(topic, "odometry_fused") &&
               !endsWith(topic, "odometry_live");
      });
}

bool isCompressed(const DoctorRecording& recording) {
  const auto topic = recording.topics.find(recording.image_topic);
  return topic != recording.topics.end() && topic->second.type == kCompressed;
}

std::string navdataTopic(const DoctorRecording& recording) {
  for (const auto& topic : recording.topics) {
    if (endsWith(topic.second.type, "/Navdata")) return topic.first;
  }
  return {};
}

}  // namespace ardrone_vslam
