// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "bags/bag_sequence.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/camera_info.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {

/// What a test bag holds; each test changes what it is about.
struct BagRecipe {
  std::vector<double> image_stamps_s{1.0, 1.1, 1.2, 1.3};
  std::string encoding = "mono8";
  cv::Size size_px{32, 24};
  bool has_camera_info = true;
  sensor_msgs::CameraInfo camera_info;
  bool has_tf = true;
  std::vector<nav_msgs::Odometry> odometry;

  BagRecipe() {
    CameraIntrinsics camera;
    camera.width_px = 32;
    camera.height_px = 24;
    camera.fx_px = 20;
    camera.fy_px = 21;
    camera.cx_px = 16;
    camera.cy_px = 12;
    camera.k1 = -0.5;
    camera_info = cameraInfoFromIntrinsics(camera);
    for (int i = 0; i < 5; ++i) odometry.push_back(odometryAt(1.0 + 0.1 * i, 0.5 * i));
  }

  static nav_msgs::Odometry odometryAt(double stamp_s, double x_m) {
    nav_msgs::Odometry message;
    message.header.stamp = ros::Time(stamp_s);
    message.header.frame_id = "odom";
    message.child_frame_id = "/base";
    message.pose.pose.position.x = x_m;
    message.pose.pose.orientation.w = 1;
    message.pose.covariance[0] = 0.25;
    message.pose.covariance[35] = 0.5;
    return message;
  }
};

inline sensor_msgs::Image imageMessage(const BagRecipe& recipe, int index) {
  const int channels = recipe.encoding.rfind("mono", 0) == 0 || recipe.encoding == "8UC1" ||
                               recipe.encoding.rfind("bayer", 0) == 0
                           ? 1
                           : 3;
  const cv::Mat grey = testImage(index, recipe.size_px.width, recipe.size_px.height);
  cv::Mat pixels = grey;
  if (channels == 3) cv::cvtColor(grey, pixels, cv::COLOR_GRAY2BGR);
  if (recipe.encoding == "mono16") grey.convertTo(pixels, CV_16U, 257);
  sensor_msgs::Image message;
  message.header.stamp = ros::Time(recipe.image_stamps_s[static_cast<std::size_t>(index)]);
  message.header.frame_id = "cam";
  message.encoding = recipe.encoding;
  message.width = static_cast<std::uint32_t>(grey.cols);
  message.height = static_cast<std::uint32_t>(grey.rows);
  message.step = static_cast<std::uint32_t>(pixels.elemSize()) * message.width;
  message.data.assign(pixels.data, pixels.data + pixels.total() * pixels.elemSize());
  return message;
}

inline void writeRecipe(rosbag::Bag& bag, const BagRecipe& recipe) {
  ros::Time now(1.0);
  const auto next = [&now] { return now += ros::Duration(0.01); };
  for (std::size_t i = 0; i < recipe.image_stamps_s.size(); ++i) {
    bag.write("/cam/image", next(), imageMessage(recipe, static_cast<int>(i)));
    if (recipe.has_camera_info) bag.write("/cam/camera_info", next(), recipe.camera_info);
  }
  for (const auto& message : recipe.odometry) bag.write("/odom", next(), message);
  if (!recipe.has_tf) return;
  // As ardrone_autonomy: dynamic transforms, here with a frame between base and camera.
  Eigen::Isometry3d T_base_mount = Eigen::Isometry3d::Identity();
  T_base_mount.translation() << 0.2, 0, 0;
  tf2_msgs::TFMessage tf;
  tf.transforms = {toTransformMessage(T_base_mount, ros::Time(1.0), "base", "mount"),
                   toTransformMessage(forwardCamera(), ros::Time(1.0), "mount", "cam")};
  bag.write("/tf", next(), tf);
}

/// Writes a bag of the recipe, with what `more` adds.
class TestBag {
 public:
  explicit TestBag(
      const BagRecipe& recipe,
      const std::function<void(rosbag::Bag&)>& more = [](rosbag::Bag&) {}) {
    rosbag::Bag bag(path(), rosbag::bagmode::Write);
    writeRecipe(bag, recipe);
    more(bag);
    bag.close();
  }
  std::string path() const { return folder_.file("test.bag"); }
  std::unique_ptr<BagSequence> open(const BagReadOptions& options = {}) const {
    return openBag(path(), options);
  }
  void expectRefused(const std::vector<std::string>& parts,
                     const BagReadOptions& options = {}) const {
    expectError([&] { open(options); }, parts);
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace ardrone_vslam
