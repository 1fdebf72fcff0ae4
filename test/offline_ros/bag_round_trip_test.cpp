// SPDX-License-Identifier: BSD-3-Clause
// Folder -> bag -> sequence: the same pixels, stamps, poses and calibration.

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <yaml-cpp/yaml.h>

#include <iterator>
#include <set>

#include "ardrone_vslam/height_input.hpp"
#include "bags/bag_sequence.hpp"
#include "bags/bag_writer.hpp"
#include "pave/pave_sequence.hpp"
#include "support/pave_capture.hpp"
#include "support/read_file.hpp"
#include "support/real_data.hpp"
#include "support/same_pose.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

using test::expectSamePose;
using test::realData;

constexpr std::int64_t kOffset_ns = 100'000'000'000;

OdometryProfile driftingProfile() {
  OdometryProfile profile;
  profile.name = "drifting";
  profile.rate_hz = 50;
  profile.scale_sigma = 0.02;
  profile.velocity_noise_m_s = 0.05;
  profile.yaw_walk_rad_per_sqrt_s = 0.01;
  return profile;
}

BagWriteOptions driftingOptions() {
  BagWriteOptions options;
  options.odometry_profile = driftingProfile();
  options.seed = 7;
  options.tool = "test 1.0";
  return options;
}

void expectSameImages(Sequence& a, Sequence& b, std::int64_t offset_ns) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.stamp_ns(i) + offset_ns, b.stamp_ns(i));
    EXPECT_EQ(cv::norm(a.image(i), b.image(i), cv::NORM_INF), 0) << i;
  }
}

void expectSameTruth(const Trajectory& a, const Trajectory& b, std::int64_t offset_ns) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.poses()[i].stamp_ns + offset_ns, b.poses()[i].stamp_ns);
    expectSamePose(a.poses()[i].T_frame_body, b.poses()[i].T_frame_body);
  }
}

TEST(BagRoundTrip, KittiFolderWithSimulatedOdometry) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 6);
  const auto source = openFolder(folder.path());
  const auto report = writeBag(*source, driftingOptions(), folder.file("out.bag"));
  EXPECT_EQ(report.images, 6u);
  EXPECT_EQ(report.truth, 6u);
  EXPECT_EQ(report.stamp_offset_ns, kOffset_ns);
  EXPECT_NE(report.scale_error, 0);

  const auto bag = openBag(folder.file("out.bag"), {});
  EXPECT_TRUE(bag->findings().warnings.empty());
  EXPECT_TRUE(bag->camera() == source->camera());
  expectSamePose(bag->T_base_cam(), source->T_base_cam());
  expectSameImages(*source, *bag, kOffset_ns);
  expectSameTruth(source->truth(), bag->truth(), kOffset_ns);
  const auto run = simulateOdometry(source->truth(), driftingProfile(), 7);
  ASSERT_EQ(bag->odometry().size(), run.states.size());
  EXPECT_EQ(report.odometry, run.states.size());
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    EXPECT_EQ(bag->odometry()[i].stamp_ns, run.states[i].stamp_ns + kOffset_ns);
    expectSamePose(bag->odometry()[i].T_odom_base, run.states[i].T_odom_base);
  }
}

TEST(BagRoundTrip, RecordedOdometryWithDistortionAndOwnNames) {
  TemporaryFolder folder;
  makeTumFolder(folder, 4);
  folder.write("times.txt", "1305031102.175304\n1305031102.211214\n1305031102.3\n1305031102.4\n");
  folder.write("poses_tum.txt", "1305031102.1 1 2 3 0 0 0 1\n1305031102.5 2 2 3 0 0 0 1\n");
  folder.write("odometry_tum.txt",
               "1305031102.1 1 0 0 0 0 0.6 0.8\n1305031102.2 1 1 0 0 0 0.6 0.8\n"
               "1305031102.2 1 2 0 0 0 0.6 0.8\n1305031102.5 1 5 0 0 0 0.6 0.8\n");
  BagWriteOptions options;
  options.topics.image = "/drone/front/image";
  options.topics.camera_info = "/drone/front/camera_info";
  options.topics.odometry = "/drone/odom";
  options.frames.base = "drone_base";
  options.frames.camera = "drone_cam";
  const auto source = openFolder(folder.path());
  EXPECT_EQ(writeBag(*source, options, folder.file("out.bag")).stamp_offset_ns, 0);
  const auto bag = openBag(folder.file("out.bag"), {});
  EXPECT_TRUE(bag->camera() == source->camera());
  EXPECT_EQ(bag->stamp_ns(0), 1305031102'175304000);
  expectSameImages(*source, *bag, 0);
  expectSameTruth(source->truth(), bag->truth(), 0);
  ASSERT_EQ(bag->odometry().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(bag->odometry()[i].stamp_ns, source->odometry()[i].stamp_ns);
    expectSamePose(bag->odometry()[i].T_odom_base, source->odometry()[i].T_odom_base);
  }
}

TEST(BagRoundTrip, RangesGiveTheSameHeights) {
  TemporaryFolder folder;
  makeTumFolder(folder, 6);
  std::string ranges;
  for (int i = 0; i < 12; ++i)
    ranges += std::to_string(0.01 + 0.05 * i) + " " + std::to_string(1.2 + 0.0123 * i) + "\n";
  folder.write("range.txt", ranges);
  const auto source = openFolder(folder.path());
  writeBag(*source, driftingOptions(), folder.file("out.bag"));
  EXPECT_TRUE(openBag(folder.file("out.bag"), {})->ranges().empty()) << "nobody asked for them";
  BagReadOptions options;
  options.use_range = true;
  const auto bag = openBag(folder.file("out.bag"), options);
  const std::vector<RangeReading> before = source->ranges();
  const std::vector<RangeReading> after = bag->ranges();
  ASSERT_EQ(before.size(), 12u);
  ASSERT_EQ(after.size(), before.size());
  HeightInputConfig config;
  config.use_range = true;
  HeightInput from_folder(config, 10);
  HeightInput from_bag(config, 10);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(from_folder.push(before[i]), HeightInput::Push::kAccepted);
    EXPECT_EQ(from_bag.push(after[i]), HeightInput::Push::kAccepted);
  }
  constexpr double kSingle_m = 1e-6;  // sensor_msgs/Range is of single precision
  int heights = 0;
  OdometryState here;
  OdometryState there;
  for (std::size_t i = 0; i < source->size(); ++i) {
    here.stamp_ns = source->stamp_ns(i);
    there.stamp_ns = bag->stamp_ns(i);
    const auto height = from_folder.at(here);
    const auto height_by_bag = from_bag.at(there);
    ASSERT_EQ(height.has_value(), height_by_bag.has_value()) << i;
    if (!height) continue;
    EXPECT_NEAR(*height, *height_by_bag, kSingle_m) << i;
    ++heights;
  }
  EXPECT_GE(heights, 5);
}

TEST(BagRoundTrip, ImagesMayBeAskedForInAnyOrder) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 6);
  writeBag(*openFolder(folder.path()), driftingOptions(), folder.file("out.bag"));
  const auto sequence =
      select(openBag(folder.file("out.bag"), {}), FrameSelection::parse("", true));
  const int order[] = {0, 2, 4, 5, 3, 1};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(cv::norm(sequence->image(i), testImage(order[i]), cv::NORM_INF), 0) << i;
  }
}

TEST(BagRoundTrip, CompressedImagesAndCompressedBags) {
  using Options = BagWriteOptions;
  TemporaryFolder folder;
  makeKittiFolder(folder, 3);
  const auto source = openFolder(folder.path());
  for (const auto format : {Options::ImageFormat::kPng, Options::ImageFormat::kJpeg}) {
    for (const auto compression : {Options::Compression::kLz4, Options::Compression::kBz2}) {
      BagWriteOptions options = driftingOptions();
      options.image_format = format;
      options.compression = compression;
      writeBag(*source, options, folder.file("out.bag"));
      const auto bag = openBag(folder.file("out.bag"), {});
      ASSERT_EQ(bag->size(), 3u);
      const bool is_exact = format == Options::ImageFormat::kPng;
      EXPECT_LE(cv::norm(source->image(2), bag->image(2), cv::NORM_L1) / (32 * 24),
                is_exact ? 0.0 : 25.0);
      EXPECT_EQ(bag->image(2).size(), cv::Size(32, 24));
    }
  }
}

TEST(BagWriter, EqualArgumentsGiveEqualBytes) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 4);
  const auto source = openFolder(folder.path());
  BagWriteOptions options = driftingOptions();
  writeBag(*source, options, folder.file("a.bag"));
  writeBag(*source, options, folder.file("b.bag"));
  EXPECT_EQ(test::readFile(folder.file("a.bag")), test::readFile(folder.file("b.bag")));
  options.seed = 8;
  writeBag(*source, options, folder.file("c.bag"));
  EXPECT_NE(test::readFile(folder.file("a.bag")), test::readFile(folder.file("c.bag")));
}

TEST(BagWriter, MessagesComeInTheOrderOfTimeAtTheirStamps) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 4);
  writeBag(*openFolder(folder.path()), driftingOptions(), folder.file("out.bag"));
  rosbag::Bag bag(folder.file("out.bag"));
  ros::Time last;
  std::map<std::string, std::size_t> counts;
  bool is_static_latched = false;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    EXPECT_GE(instance.getTime(), last);
    last = instance.getTime();
    ++counts[instance.getTopic()];
    if (const auto odometry = instance.instantiate<nav_msgs::Odometry>()) {
      EXPECT_EQ(odometry->header.stamp, instance.getTime());
      EXPECT_EQ(odometry->header.frame_id, "odom");
      EXPECT_EQ(odometry->child_frame_id, "base_link");
    }
    if (instance.getTopic() == "/tf_static") is_static_latched = instance.isLatching();
    if (const auto text = instance.instantiate<std_msgs::String>()) {
      const YAML::Node info = YAML::Load(text->data);
      EXPECT_EQ(info["odometry_profile"].as<std::string>(), "drifting");
      EXPECT_EQ(info["seed"].as<int>(), 7);
      EXPECT_NE(info["scale_error"].as<double>(), 0);
      EXPECT_EQ(info["stamp_offset_s"].as<double>(), 100);
      EXPECT_EQ(info["tool"].as<std::string>(), "test 1.0");
    }
  }
  EXPECT_TRUE(is_static_latched);
  EXPECT_EQ(counts["/camera/image_raw"], 4u);
  EXPECT_EQ(counts["/camera/camera_info"], 4u);
  EXPECT_EQ(counts["/truth/pose"], 4u);
  EXPECT_EQ(counts["/tf_static"], 1u);
  EXPECT_EQ(counts["/make_bag/info"], 1u);
  EXPECT_EQ(counts["/tf"], counts["/odometry"]);
}

TEST(BagWriter, TwistIsTheMotionInBase) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 4);  // base looks along map's -y and moves along it: forward at 5 m/s
  BagWriteOptions options;
  options.odometry_profile = OdometryProfile();
  options.odometry_profile->name = "truth";
  writeBag(*openFolder(folder.path()), options, folder.file("out.bag"));
  rosbag::Bag bag(folder.file("out.bag"));
  std::size_t count = 0;
  rosbag::View view(bag, rosbag::TopicQuery("/odometry"));
  for (const rosbag::MessageInstance& instance : view) {
    const auto odometry = instance.instantiate<nav_msgs::Odometry>();
    if (count++ == 0) continue;  // nothing comes before the first
    EXPECT_NEAR(odometry->twist.twist.linear.x, 5, 1e-5);
    EXPECT_NEAR(odometry->twist.twist.linear.y, 0, 1e-5);
    EXPECT_NEAR(odometry->twist.twist.angular.z, 0, 1e-5);
  }
  EXPECT_GT(count, 10u);
}

TEST(BagWriter, FailureLeavesNothingBehindAndKeepsTheOldBag) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 3);
  folder.write("image_0/000002.png", "no image");
  folder.write("out.bag", "the old one");
  const auto source = openFolder(folder.path());
  const std::string out = folder.file("out.bag");
  expectError([&] { writeBag(*source, driftingOptions(), out); }, {"000002.png"});
  EXPECT_EQ(test::readFile(out), "the old one");
  EXPECT_FALSE(std::filesystem::exists(out + ".part"));
  expectError([&] { writeBag(*source, driftingOptions(), folder.file("none/out.bag")); },
              {"none/out.bag", "cannot be written", "permissions"});
}

TEST(BagWriter, ProfileNeedsTruth) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 3);
  folder.remove("poses.txt");
  const auto source = openFolder(folder.path());
  const std::string out = folder.file("out.bag");
  expectError([&] { writeBag(*source, driftingOptions(), out); },
              {"no true poses", "'drifting'", "give the truth"});
  EXPECT_EQ(writeBag(*source, {}, out).odometry, 0u);
  const auto bag = openBag(out, {});
  EXPECT_TRUE(bag->odometry().empty());
  EXPECT_TRUE(bag->truth().empty());
  // Without odometry base is the camera's parent in tf.
  expectSamePose(bag->T_base_cam(), forwardCamera());
}

TEST(RealBag, KittiClipThereAndBack) {
  if (realData().empty()) GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set";
  TemporaryFolder folder;
  const auto source =
      select(openFolder(realData() + "/kitti_05_clip"), FrameSelection::parse("10:30:3", true));
  const auto report = writeBag(*source, driftingOptions(), folder.file("out.bag"));
  const auto bag = openBag(folder.file("out.bag"), {});
  EXPECT_TRUE(bag->camera() == source->camera());
  expectSameImages(*source, *bag, report.stamp_offset_ns);
  expectSameTruth(source->truth(), bag->truth(), report.stamp_offset_ns);
}

TEST(BagRoundTrip, TheBottomCameraOfAVideoStreamHasItsOwnFrameAndCalibration) {
  TemporaryFolder folder;
  PaveCapture capture;
  capture.add(3, 32, 24, 1, 5000);
  capture.add(2, 48, 32, 16, 5495);
  capture.add(1, 32, 24, 26, 5825);
  folder.write("video.pave", capture.text());
  folder.write("camera.yaml", paveCameraYaml(32, 24));
  folder.write("bottom.yaml", paveCameraYaml(48, 32));
  PaveOptions pave;
  pave.bottom_camera_yaml = folder.file("bottom.yaml");
  pave.at_rest = true;
  const auto stream = openPave(folder.file("video.pave"), pave);
  writeBag(*stream, driftingOptions(), folder.file("a.bag"));
  BagReadOptions read;
  read.base_frame = "base_link";
  const auto bag = openBag(folder.file("a.bag"), read);
  expectSameImages(*stream, *bag, 0);
  ASSERT_EQ(bag->size(), 30U);
  for (std::size_t i = 0; i < bag->size(); ++i) {
    const SequenceCamera a = stream->cameraAt(stream->cameraOf(i));
    const SequenceCamera b = bag->cameraAt(bag->cameraOf(i));
    EXPECT_TRUE(a.intrinsics == b.intrinsics) << i;
    expectSamePose(a.T_base_cam, b.T_base_cam);
  }
  EXPECT_NE(bag->cameraOf(0), bag->cameraOf(15));
  const rosbag::Bag file(folder.file("a.bag"), rosbag::bagmode::Read);
  std::set<std::string> frames;
  for (const auto& instance : rosbag::View(file, rosbag::TopicQuery("/camera/camera_info")))
    frames.insert(instance.instantiate<sensor_msgs::CameraInfo>()->header.frame_id);
  EXPECT_EQ(frames, (std::set<std::string>{"camera_optical", "camera_optical_2"}));
}

}  // namespace
}  // namespace ardrone_vslam
