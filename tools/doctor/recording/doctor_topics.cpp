// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/recording/doctor_topics.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "bags/check/topic_names.hpp"

namespace ardrone_vslam {
namespace {

const char* const kImage = "sensor_msgs/Image";
const char* const kCompressed = "sensor_msgs/CompressedImage";
const char* const kCameraInfo = "sensor_msgs/CameraInfo";
const char* const kOdometry = "nav_msgs/Odometry";
const char* const kNavdata = "ardrone_autonomy/Navdata";
const char* const kOwnNavdata = "ardrone_vslam/Navdata";  // another name, the same fields
const char* const kImu = "sensor_msgs/Imu";
const char* const kTwist = "geometry_msgs/Twist";

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

/// What a topic is looked for.
struct Role {
  std::string option;              ///< of replay that names it; empty: replay does not need it
  std::vector<std::string> types;  ///< that fit
};

bool anyTopic(const std::string& /*topic*/) {
  return true;
}

/// The topics that a role may take.
std::vector<std::string> candidatesOf(const DoctorRecording& recording, const Role& role,
                                      const std::function<bool(const std::string&)>& is_candidate) {
  std::vector<std::string> candidates;
  for (const auto& topic : recording.topics) {
    if (isOneOf(role.types, topic.second.type) && is_candidate(topic.first))
      candidates.push_back(topic.first);
  }
  return candidates;
}

/// The usual one, else the one with most messages, of those the one with the shortest name.
std::string bestOf(const DoctorRecording& recording, const std::vector<std::string>& candidates,
                   const std::string& usual) {
  if (std::find(candidates.begin(), candidates.end(), usual) != candidates.end()) return usual;
  const auto isBetter = [&recording](const std::string& a, const std::string& b) {
    const std::size_t of_a = recording.topics.at(a).messages;
    const std::size_t of_b = recording.topics.at(b).messages;
    return of_a != of_b ? of_a > of_b : a.size() < b.size();
  };
  const auto best = std::min_element(candidates.begin(), candidates.end(), isBetter);
  return best == candidates.end() ? std::string() : *best;
}

/// @param name  that the user gave; empty: none
/// @param usual  taken where it fits, whatever else does
std::string best(DoctorRecording& recording, const Role& role, const std::string& name,
                 const std::function<bool(const std::string&)>& is_candidate,
                 const std::string& usual = {}) {
  if (!name.empty()) {
    std::string chosen = named(recording, name, role.types);
    if (!role.option.empty()) recording.replay_options.push_back(role.option + " " + chosen);
    return chosen;
  }
  const std::vector<std::string> candidates = candidatesOf(recording, role, is_candidate);
  std::string chosen = bestOf(recording, candidates, usual);
  if (candidates.size() < 2) return chosen;
  if (chosen != usual) {
    recording.choices.push_back(chosen + " is one of " + std::to_string(candidates.size()) +
                                " that fit");
  }
  if (!role.option.empty()) recording.replay_options.push_back(role.option + " " + chosen);
  return chosen;
}

/// What the mapper publishes is no odometry, nor is the truth.
bool isOdometry(const std::string& topic) {
  return topic.find("truth") == std::string::npos && !isFusedOdometry(topic);
}

}  // namespace

void chooseTopics(const DoctorTopicNames& names, DoctorRecording& recording) {
  const auto& topics = recording.topics;
  recording.choices.clear();
  recording.replay_options.clear();
  const Role image{"--image-topic", {kImage, kCompressed}};
  recording.image_topic = best(recording, image, names.image, [&topics](const std::string& topic) {
    return mayBeCameraImage(topic, topics.at(topic).type == kCompressed, topics);
  });
  const std::string raw =
      isCompressed(recording) ? parentName(recording.image_topic) : recording.image_topic;
  const std::string beside = parentName(raw) + "/camera_info";
  const bool is_beside = topics.count(beside) > 0 && topics.at(beside).type == kCameraInfo;
  if (names.camera_info.empty() && is_beside) {
    recording.camera_info_topic = beside;  // replay takes it, too
  } else {
    recording.camera_info_topic =
        best(recording, {"--camera-info-topic", {kCameraInfo}}, names.camera_info, anyTopic);
  }
  recording.odometry_topic =
      best(recording, {"--odometry-topic", {kOdometry}}, names.odometry, isOdometry);
  // Without odometry they are the odometry, else replay looks at navdata's height only.
  const bool is_own_observer = recording.odometry_topic.empty();
  const auto option = [is_own_observer](const char* name) {
    return is_own_observer ? std::string(name) : std::string();
  };
  recording.navdata_topic =
      best(recording, {"--navdata-topic", {kNavdata, kOwnNavdata}}, names.navdata, anyTopic);
  if (recording.navdata_topic.empty() && names.imu.empty()) {
    recording.imu_topic.clear();
    return;
  }
  recording.imu_topic = best(recording, {option("--imu-topic"), {kImu}}, names.imu, anyTopic,
                             parentName(recording.navdata_topic) + "/imu");
  if (is_own_observer) best(recording, {"--command-topic", {kTwist}}, {}, anyTopic, "/cmd_vel");
}

bool isCompressed(const DoctorRecording& recording) {
  const auto topic = recording.topics.find(recording.image_topic);
  return topic != recording.topics.end() && topic->second.type == kCompressed;
}

}  // namespace ardrone_vslam
