// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_writer.hpp"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/image_encodings.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "bags/bag_contents.hpp"
#include "bags/messages/bag_file.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/camera_info.hpp"

namespace ardrone_vslam {
namespace {

/// The last part of a path: a bag that is passed on need not tell where its maker keeps his files.
std::string sourceName(const Sequence& sequence) {
  const auto path = std::filesystem::path(sequence.name() + "/").lexically_normal();
  return path.parent_path().filename().string();
}

std::string infoText(const Sequence& sequence, const BagWriteOptions& options,
                     const BagWriteReport& report) {
  YAML::Emitter yaml;
  yaml << YAML::BeginMap << YAML::Key << "tool" << YAML::Value << options.tool;
  yaml << YAML::Key << "source" << YAML::Value << sourceName(sequence);
  if (options.odometry_profile) {
    yaml << YAML::Key << "odometry_profile" << YAML::Value << options.odometry_profile->name;
    yaml << YAML::Key << "seed" << YAML::Value << options.seed;
    yaml << YAML::Key << "scale_error" << YAML::Value << report.scale_error;
  } else {
    yaml << YAML::Key << "odometry_profile" << YAML::Value
         << (sequence.odometry().empty() ? "none" : "recorded");
  }
  yaml << YAML::Key << "stamp_offset_s" << YAML::Value
       << static_cast<double>(report.stamp_offset_ns) * 1e-9;
  yaml << YAML::EndMap;
  return yaml.c_str();
}

class BagWriter {
 public:
  BagWriter(Sequence& sequence, const BagWriteOptions& options, BagContents contents,
            rosbag::Bag& bag)
      : sequence_(sequence), options_(options), contents_(std::move(contents)), bag_(bag) {
    for (std::size_t i = 0; i < sequence.size(); ++i) cameras_[sequence.cameraOf(i)] = {};
    for (auto& camera : cameras_)
      camera.second = cameraInfoFromIntrinsics(sequence.cameraAt(camera.first).intrinsics);
    odometry_ = toOdometryMessages(contents_.odometry, options.frames.odom, options.frames.base);
  }

  /// All messages by stamp; of equal stamps what an image needs comes before it.
  void writeAll(const std::string& info) {
    writeLatched(info);
    std::size_t image = 0, odometry = 0, truth = 0, range = 0;
    static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();
    const auto stampOr = [](const auto& list, std::size_t i) {
      return i < list.size() ? list[i].stamp_ns : kNever_ns;
    };
    while (true) {
      const std::int64_t odometry_ns = stampOr(contents_.odometry, odometry);
      const std::int64_t truth_ns = stampOr(contents_.truth, truth);
      const std::int64_t range_ns = stampOr(contents_.ranges, range);
      const std::int64_t image_ns =
          image < contents_.image_stamps_ns.size() ? contents_.image_stamps_ns[image] : kNever_ns;
      const std::int64_t next_ns = std::min({odometry_ns, truth_ns, range_ns, image_ns});
      if (next_ns == kNever_ns) break;
      if (next_ns == odometry_ns) {
        writeOdometry(odometry++);
      } else if (next_ns == truth_ns) {
        writeTruth(contents_.truth[truth++]);
      } else if (next_ns == range_ns) {
        writeRange(contents_.ranges[range++]);
      } else {
        writeImage(image++);
      }
    }
  }

 private:
  std::string cameraFrame(std::size_t which) const {
    return options_.frames.camera + (which == 0 ? "" : "_" + std::to_string(which + 1));
  }

  void writeLatched(const std::string& info) {
    const ros::Time start = toRosTime(contents_.firstStamp_ns());
    tf2_msgs::TFMessage extrinsics;
    for (const auto& camera : cameras_) {
      extrinsics.transforms.push_back(
          toTransformMessage(sequence_.cameraAt(camera.first).T_base_cam, start,
                             options_.frames.base, cameraFrame(camera.first)));
    }
    bag_.write("/tf_static", start, extrinsics, latchedHeader(extrinsics));
    std_msgs::String text;
    text.data = info;
    bag_.write(options_.topics.info, start, text, latchedHeader(text));
  }

  void writeOdometry(std::size_t index) {
    const nav_msgs::Odometry& message = odometry_[index];
    const ros::Time& stamp = message.header.stamp;
    bag_.write(options_.topics.odometry, stamp, message);
    // tf refuses a second transform of the same stamp.
    if (index > 0 && stamp == odometry_[index - 1].header.stamp) return;
    tf2_msgs::TFMessage tf;
    tf.transforms = {toTransformMessage(contents_.odometry[index].T_odom_base, stamp,
                                        options_.frames.odom, options_.frames.base)};
    bag_.write("/tf", stamp, tf);
  }

  void writeTruth(const StampedPose& pose) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = toRosTime(pose.stamp_ns);
    message.header.frame_id = options_.frames.map;
    message.pose = toPose(pose.T_frame_body);
    bag_.write(options_.topics.truth, message.header.stamp, message);
  }

  void writeRange(const RangeReading& reading) {
    sensor_msgs::Range message;
    message.header.stamp = toRosTime(reading.stamp_ns);
    message.header.frame_id = options_.frames.base;
    message.range = static_cast<float>(reading.range_m);
    message.min_range = static_cast<float>(reading.min_m);
    message.max_range = static_cast<float>(reading.max_m);
    bag_.write(options_.topics.range, message.header.stamp, message);
  }

  void writeImage(std::size_t index) {
    std_msgs::Header header;
    header.stamp = toRosTime(contents_.image_stamps_ns[index]);
    const std::size_t which = sequence_.cameraOf(index);
    header.frame_id = cameraFrame(which);
    const cv::Mat image = sequence_.image(index);
    sensor_msgs::CameraInfo& camera_info = cameras_.at(which);
    camera_info.header = header;
    bag_.write(options_.topics.camera_info, header.stamp, camera_info);
    if (options_.image_format == BagWriteOptions::ImageFormat::kRaw) {
      const cv_bridge::CvImage bridge(header, sensor_msgs::image_encodings::MONO8, image);
      bag_.write(options_.topics.image, header.stamp, *bridge.toImageMsg());
    } else {
      const bool is_png = options_.image_format == BagWriteOptions::ImageFormat::kPng;
      bag_.write(options_.topics.image + "/compressed", header.stamp,
                 compressedImage(header, image, is_png));
    }
    if (options_.progress) options_.progress(index + 1, contents_.image_stamps_ns.size());
  }

  Sequence& sequence_;
  const BagWriteOptions& options_;
  BagContents contents_;
  rosbag::Bag& bag_;
  std::map<std::size_t, sensor_msgs::CameraInfo> cameras_;  // by SequenceCamera
  std::vector<nav_msgs::Odometry> odometry_;
};

}  // namespace

BagWriteReport writeBag(Sequence& sequence, const BagWriteOptions& options,
                        const std::string& path) {
  BagWriteReport report;
  if (sequence.size() == 0) {
    throw std::runtime_error(sequence.name() + ": has no image; there is nothing to write");
  }
  BagContents contents = contentsOf(sequence, options.odometry_profile, options.seed);
  report.scale_error = contents.scale_error;
  report.stamp_offset_ns = contents.stamp_offset_ns;
  report.images = contents.image_stamps_ns.size();
  report.odometry = contents.odometry.size();
  report.truth = contents.truth.size();
  writeBagFile(path, options.compression, [&](rosbag::Bag& bag) {
    BagWriter(sequence, options, std::move(contents), bag)
        .writeAll(infoText(sequence, options, report));
  });
  return report;
}

}  // namespace ardrone_vslam
