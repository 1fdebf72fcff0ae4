// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_topics.hpp"

#include <rosbag/view.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
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
const char* const kRange = "sensor_msgs/Range";
const char* const kImu = "sensor_msgs/Imu";
const char* const kTwist = "geometry_msgs/Twist";

/// One role that a topic of the bag can play.
struct Role {
  std::string what;                ///< for messages
  std::string option;              ///< that names the topic
  std::vector<std::string> types;  ///< that fit
  bool has_parent = false;         ///< of several topics the one in the namespace above is taken
};

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string listOf(const TopicTypes& types) {
  std::string list;
  for (const auto& topic : types) {
    list += (list.empty() ? "" : ", ") + topic.first + " (" + topic.second + ")";
  }
  return list;
}

/// Namespace of an image topic, raw or compressed.
std::string cameraOf(const std::string& topic) {
  return parentName(boost::algorithm::ends_with(topic, "/compressed") ? parentName(topic) : topic);
}

/// Of ardrone_autonomy's topics the one of whichever camera streams; empty when there is none.
std::string aboveAllOthers(const std::vector<std::string>& candidates) {
  for (const std::string& one : candidates) {
    const auto is_above = [&one](const std::string& other) {
      return other == one || parentName(cameraOf(other)) == cameraOf(one);
    };
    if (!cameraOf(one).empty() && std::all_of(candidates.begin(), candidates.end(), is_above))
      return one;
  }
  return {};
}

class TopicChooser {
 public:
  TopicChooser(const std::string& path, const TopicTypes& types) : path_(path), types_(types) {}

  /// The named topic, or the only one that fits; empty when there is none.
  std::string choose(const Role& role, const std::string& name,
                     const std::function<bool(const std::string&)>& is_candidate) const {
    if (!name.empty()) return named(role, name);
    std::vector<std::string> candidates;
    for (const auto& topic : types_) {
      if (contains(role.types, topic.second) && is_candidate(topic.first)) {
        candidates.push_back(topic.first);
      }
    }
    std::string streaming = role.has_parent ? aboveAllOthers(candidates) : "";
    if (!streaming.empty()) return streaming;
    if (candidates.size() > 1) {
      throw std::runtime_error(path_ + ": has several topics for the " + role.what + ": " +
                               listOf(candidates) + "; choose one by " + role.option);
    }
    return candidates.empty() ? std::string() : candidates.front();
  }

  [[noreturn]] void refuseMissing(const Role& role, const std::string& remedy) const {
    throw std::runtime_error(path_ + ": has no topic for the " + role.what + " (" +
                             listOf(role.types) + "); " + remedy +
                             ". Topics there: " + listOf(types_));
  }

 private:
  std::string named(const Role& role, const std::string& name) const {
    auto topic = types_.find(name);
    if (topic == types_.end()) topic = types_.find("/" + name);
    if (topic == types_.end()) {
      throw std::runtime_error(path_ + ": has no topic " + name + " (" + role.option +
                               "). Topics there: " + listOf(types_));
    }
    if (!contains(role.types, topic->second)) {
      throw std::runtime_error(path_ + ": " + topic->first + " is " + topic->second + ", but the " +
                               role.what + " must be " + listOf(role.types) +
                               ". Topics there: " + listOf(types_));
    }
    return topic->first;
  }

  const std::string& path_;
  const TopicTypes& types_;
};

std::string chooseCameraInfo(const TopicChooser& chooser, const TopicTypes& types,
                             const BagReadOptions& options, const ChosenTopics& topics) {
  const Role role{"calibration", "--camera-info-topic", {kCameraInfo}};
  // image_transport's rule: camera_info stands beside the raw image's topic.
  const std::string raw = topics.is_compressed ? parentName(topics.image) : topics.image;
  const std::string beside = parentName(raw) + "/camera_info";
  std::string name = options.camera_info_topic;
  if (name.empty() && types.count(beside) != 0) name = beside;
  std::string chosen = chooser.choose(role, name, [](const std::string&) { return true; });
  if (chosen.empty()) {
    chooser.refuseMissing(role, "record " + beside +
                                    " with the images, or give the calibration "
                                    "as a file by --camera");
  }
  return chosen;
}

bool any(const std::string&) {
  return true;
}

/// Without it the AR.Drone's observer does with less.
void chooseImu(const TopicChooser& chooser, const BagReadOptions& options, ChosenTopics& topics) {
  const Role imu{"IMU", "--imu-topic", {kImu}};
  topics.imu = chooser.choose(imu, options.imu_topic, any);
  if (topics.imu.empty() && options.odometry_mode == OdometryMode::kImu)
    chooser.refuseMissing(imu, "record the IMU's, or set odometry_mode to pose");
}

/// The driver's own type and this package's differ in their name only.
void chooseNavdata(const TopicChooser& chooser, const BagReadOptions& options,
                   ChosenTopics& topics) {
  const Role navdata{
      "navdata", "--navdata-topic", {"ardrone_autonomy/Navdata", "ardrone_vslam/Navdata"}};
  topics.navdata = chooser.choose(navdata, options.navdata_topic, any);
  if (options.odometry_mode != OdometryMode::kNavdata)
    return;  // only for heights, without which it goes on
  if (topics.navdata.empty()) {
    chooser.refuseMissing(navdata, "record the driver's, or set odometry_mode to twist or pose");
  }
  topics.command =
      chooser.choose({"commands", "--command-topic", {kTwist}}, options.command_topic, any);
}

}  // namespace

TopicTypes topicTypes(const rosbag::Bag& bag) {
  TopicTypes types;
  rosbag::View view(bag);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    types[connection->topic] = connection->datatype;
  }
  return types;
}

ChosenTopics chooseTopics(const std::string& path, const TopicTypes& types,
                          const BagReadOptions& options) {
  const TopicChooser chooser(path, types);
  ChosenTopics topics;
  const Role image{"images", "--image-topic", {kImage, kCompressed}, true};
  topics.image = chooser.choose(image, options.image_topic, [&types](const std::string& topic) {
    return mayBeCameraImage(topic, types.at(topic) == kCompressed, types);
  });
  if (topics.image.empty()) chooser.refuseMissing(image, "record the camera's images");
  topics.is_compressed = types.at(topics.image) == kCompressed;
  if (!options.camera) topics.camera_info = chooseCameraInfo(chooser, types, options, topics);

  const Role truth{
      "truth",
      "--truth-topic",
      {"geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped", kOdometry}};
  topics.truth = chooser.choose(truth, options.truth_topic, [](const std::string& topic) {
    return topic.find("truth") != std::string::npos;
  });
  const bool is_of_navdata = options.odometry_mode == OdometryMode::kNavdata;
  if (is_of_navdata || options.odometry_mode == OdometryMode::kImu)
    chooseImu(chooser, options, topics);
  if (is_of_navdata || options.use_navdata_height) chooseNavdata(chooser, options, topics);
  const Role odometry{"odometry", "--odometry-topic", {kOdometry}};
  if (!is_of_navdata)
    topics.odometry =
        chooser.choose(odometry, options.odometry_topic, [&topics](const std::string& topic) {
          return topic != topics.truth && !isFusedOdometry(topic);
        });
  if (options.use_range) {
    topics.range = chooser.choose({"range", "--range-topic", {kRange}}, options.range_topic, any);
  }
  return topics;
}

}  // namespace ardrone_vslam
