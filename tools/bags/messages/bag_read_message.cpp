// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/bag_read_message.hpp"

#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kNumber = 4;     // uint32, and a length
constexpr std::uint32_t kStart = 4 + 8;  // a header's seq and stamp; its frame_id follows
constexpr std::uint32_t kPose = 7 * 8;   // also a transform
constexpr std::uint32_t kTwist = 6 * 8;
constexpr std::uint32_t kCovariance = 36 * 8;

class LengthReader {
 public:
  explicit LengthReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void skip(std::uint64_t count) {
    if (count > bytes_.size() - at_) ros::serialization::throwStreamOverrun();
    at_ += count;
  }
  std::uint32_t length() {
    std::uint32_t value = 0;
    const std::size_t at = at_;
    skip(kNumber);
    std::memcpy(&value, bytes_.data() + at, sizeof(value));
    return value;
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

void checkLengths(const std::vector<std::uint8_t>& bytes, const SerialLayout& layout) {
  LengthReader reader(bytes);
  const std::uint32_t count = layout.is_list ? reader.length() : 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const SerialPart& part : layout.parts) {
      reader.skip(part.fixed_bytes);
      if (part.element_bytes > 0) {
        reader.skip(std::uint64_t{part.element_bytes} * reader.length());
      }
    }
  }
}

template <>
const SerialLayout& serialLayout<sensor_msgs::Image>() {
  static const SerialLayout kLayout{false, {{kStart, 1}, {2 * kNumber, 1}, {1 + kNumber, 1}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<sensor_msgs::CompressedImage>() {
  static const SerialLayout kLayout{false, {{kStart, 1}, {0, 1}, {0, 1}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<sensor_msgs::CameraInfo>() {
  // K, R and P, binning, region of interest
  static const SerialLayout kLayout{false,
                                    {{kStart, 1},
                                     {2 * kNumber, 1},
                                     {0, 8},
                                     {(9 + 9 + 12) * 8 + 2 * kNumber + 4 * kNumber + 1, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<nav_msgs::Odometry>() {
  static const SerialLayout kLayout{
      false, {{kStart, 1}, {0, 1}, {kPose + kCovariance + kTwist + kCovariance, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<Navdata>() {
  // 22 numbers, seven arrays of the tags, the clock
  static const SerialLayout kLayout{false,
                                    {{kStart, 1},
                                     {22 * kNumber, 4},
                                     {0, 4},
                                     {0, 4},
                                     {0, 4},
                                     {0, 4},
                                     {0, 4},
                                     {0, 4},
                                     {kNumber, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<sensor_msgs::Imu>() {
  // orientation, turn rate and acceleration, each with a covariance
  static const SerialLayout kLayout{false, {{kStart, 1}, {(4 + 3 + 3 + 3 * 9) * 8, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<geometry_msgs::Twist>() {
  static const SerialLayout kLayout{false, {{kTwist, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<sensor_msgs::Range>() {
  static const SerialLayout kLayout{false, {{kStart, 1}, {1 + 4 * kNumber, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<geometry_msgs::PoseStamped>() {
  static const SerialLayout kLayout{false, {{kStart, 1}, {kPose, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<geometry_msgs::PoseWithCovarianceStamped>() {
  static const SerialLayout kLayout{false, {{kStart, 1}, {kPose + kCovariance, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<tf2_msgs::TFMessage>() {
  static const SerialLayout kLayout{true, {{kStart, 1}, {0, 1}, {kPose, 0}}};
  return kLayout;
}

template <>
const SerialLayout& serialLayout<std_msgs::String>() {
  static const SerialLayout kLayout{false, {{0, 1}}};
  return kLayout;
}

}  // namespace ardrone_vslam
