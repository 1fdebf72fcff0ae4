// SPDX-License-Identifier: BSD-3-Clause
// KITTI and TUM-like folders as sequences, and what is said of wrong ones.

#include "sequences/sequence.hpp"
#include "support/real_data.hpp"
#include "support/same_pose.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

using test::expectSamePose;
using test::realData;

constexpr double kPi = 3.14159265358979323846;

TEST(KittiFolder, ImagesStampsAndCalibration) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 5);
  const auto sequence = openFolder(folder.path());
  ASSERT_EQ(sequence->size(), 5u);
  EXPECT_EQ(sequence->stamp_ns(3), 300'000'000);
  EXPECT_EQ(cv::norm(sequence->image(3), testImage(3), cv::NORM_INF), 0);
  EXPECT_EQ(sequence->camera().width_px, 32);
  EXPECT_EQ(sequence->camera().height_px, 24);
  EXPECT_EQ(sequence->camera().fx_px, 20);
  EXPECT_EQ(sequence->camera().fy_px, 21);
  EXPECT_EQ(sequence->camera().cx_px, 16);
  EXPECT_EQ(sequence->camera().cy_px, 12);
  EXPECT_EQ(sequence->camera().k1, 0);
  EXPECT_TRUE(sequence->odometry().empty());
  expectSamePose(sequence->T_base_cam(), forwardCamera(), 1e-9);
}

TEST(KittiFolder, TruthHasTheAxesOfRep103AndKeepsItsStart) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 5);
  const auto sequence = openFolder(folder.path());
  ASSERT_EQ(sequence->truth().size(), 5u);
  // Camera axes (right, down, forward) = (3, -2, 7) are (forward, left, up) = (7, -3, 2); a turn to
  // the right is one about -z.
  Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
  expected.linear() = Eigen::AngleAxisd(-kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  expected.translation() << 7, -3, 2;
  expectSamePose(sequence->truth().poses()[0].T_frame_body, expected, 1e-9);
  expected.translation() << 7, -4, 2;
  expectSamePose(sequence->truth().poses()[2].T_frame_body, expected, 1e-9);
}

TEST(KittiFolder, TruthIsOptional) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 3);
  folder.remove("poses.txt");
  EXPECT_TRUE(openFolder(folder.path())->truth().empty());
}

TEST(KittiFolder, FaultsAreNamedWithFileAndRemedy) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 4);
  const auto open = [&folder] { openFolder(folder.path()); };
  ASSERT_NO_THROW(open());

  folder.write("times.txt", textTimes(3));
  expectError(open, {"times.txt", "3 stamps", "4 images", "one stamp for each image"});
  folder.write("times.txt", "0\n0.1\nnan\n0.3\n");
  expectError(open, {"times.txt", "line 3", "not a finite number", "correct"});
  folder.write("times.txt", "0\n0.2\n0.1\n0.3\n");
  expectError(open, {"times.txt", "line 3", "not later than the one before", "ascend"});
  folder.write("times.txt", "0\n0.2\nhalf\n0.3\n");
  expectError(open, {"times.txt", "line 3", "'half' is not a number"});
  folder.remove("times.txt");
  expectError(open, {"times.txt", "cannot be read", "one stamp in seconds a line"});
  folder.write("times.txt", textTimes(4));

  folder.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectError(open, {"poses.txt", "1 poses", "4 stamps"});
  folder.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1\n");
  expectError(open, {"poses.txt", "line 1", "11 numbers", "12"});
  folder.write("poses.txt", "1 0 0 nan 0 1 0 0 0 0 1 0\n");
  expectError(open, {"poses.txt", "line 1", "not finite"});
  folder.write("poses.txt", "1 0 0 1e300 0 1 0 0 0 0 1 0\n");
  expectError(open, {"poses.txt", "line 1", "more than 1e7 m"});
  for (const char* no_rotation : {"0 0 0 1 0 0 0 1 0 0 0 1", "2 0 0 1 0 2 0 1 0 0 2 1",
                                  "1 0 0 1 0 1 0 1 0 0 -1 1", "1 0.01 0 1 0 1 0 1 0 0 1 1"}) {
    folder.write("poses.txt", std::string("1 0 0 0 0 1 0 0 0 0 1 0\n") + no_rotation + "\n");
    expectError(open, {"poses.txt", "line 2", "no rotation"});
  }
  makeKittiFolder(folder, 4);

  folder.write("calib.txt", "P1: 20 0 16 0 0 21 12 0 0 0 1 0\n");
  expectError(open, {"calib.txt", "no line P0"});
  folder.write("calib.txt", "P0: 20 0 16 0 0 21 12\n");
  expectError(open, {"calib.txt", "7 numbers", "12"});
  folder.write("calib.txt", "P0: 700 0 600 0 0 700 180 0 0 0 1 0\n");
  expectError(open, {"calib.txt", "32x24", "belongs to the images"});
  folder.remove("calib.txt");
  expectError(open, {"calib.txt", "cannot be read", "P0"});
}

TEST(KittiFolder, DamagedAndOddImagesAreNamed) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 4);
  folder.write("image_0/000002.png", "no image");
  cv::imwrite(folder.file("image_0/000003.png"), testImage(3, 40, 24));
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", testImage(1), jpeg);
  folder.write("image_0/000001.png", std::string(jpeg.begin(), jpeg.end() - 20));
  const auto sequence = openFolder(folder.path());
  expectError([&] { sequence->image(1); },
              {"image_0/000001.png", "cannot be decoded", "truncated"});
  expectError([&] { sequence->image(2); }, {"image_0/000002.png", "cannot be decoded", "replace"});
  expectError([&] { sequence->image(3); },
              {"image_0/000003.png", "40x24", "calib.txt", "32x24", "calibration"});
}

TEST(TumFolder, ImagesCalibrationAndTruthOfOtherStamps) {
  TemporaryFolder folder;
  makeTumFolder(folder, 5);
  const auto sequence = openFolder(folder.path());
  ASSERT_EQ(sequence->size(), 5u);
  EXPECT_EQ(cv::norm(sequence->image(4), testImage(4), cv::NORM_INF), 0);
  EXPECT_EQ(sequence->camera().k1, -0.3);
  EXPECT_EQ(sequence->camera().k2, 0.1);
  EXPECT_EQ(sequence->camera().p1, 0.001);
  EXPECT_EQ(sequence->camera().p2, 0.002);
  EXPECT_EQ(sequence->camera().k3, 0.05);
  // The camera looks along the world's x axis: base has the world's axes. Poses stand at 0, 0.2 and
  // 0.4 s, the image between two of them.
  Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
  expected.translation() << 0.1, 2, 3;
  expectSamePose(sequence->truth().at(sequence->stamp_ns(1)), expected, 1e-9);
}

TEST(TumFolder, RecordedOdometryKeepsItsStamps) {
  TemporaryFolder folder;
  makeTumFolder(folder, 3);
  folder.write("odometry_tum.txt", "0 1 2 3 0 0 0 1\n0.1 2 2 3 0 0 0 1\n0.1 3 2 3 0 0 0 1\n");
  const auto sequence = openFolder(folder.path());
  ASSERT_EQ(sequence->odometry().size(), 3u);
  EXPECT_EQ(sequence->odometry()[2].stamp_ns, 100'000'000);
  EXPECT_EQ(sequence->odometry()[2].T_odom_base.translation(), Eigen::Vector3d(3, 2, 3));
}

TEST(TumFolder, OdometryUnderItsOldNameIsNotLeftOut) {
  TemporaryFolder folder;
  makeTumFolder(folder, 3);
  folder.write("observer_tum.txt", "0 1 2 3 0 0 0 1\n");
  expectError([&folder] { openFolder(folder.path()); }, {"observer_tum.txt", "odometry_tum.txt"});
}

TEST(TumFolder, FaultsAreNamedWithFileAndRemedy) {
  TemporaryFolder folder;
  makeTumFolder(folder, 4);
  const auto open = [&folder] { openFolder(folder.path()); };
  ASSERT_NO_THROW(open());

  folder.write("camera.yaml", textCameraYaml("equidistant", "0, 0, 0, 0"));
  expectError(open, {"camera.yaml", "'equidistant' is not supported", "plumb_bob"});
  folder.write("camera.yaml", textCameraYaml("plumb_bob", "0, 0, 0"));
  expectError(open, {"camera.yaml", "3 distortion coefficients", "5"});
  folder.write("camera.yaml", textCameraYaml("plumb_bob", "0, .nan, 0, 0, 0"));
  expectError(open, {"camera.yaml", "not finite"});
  folder.write("camera.yaml", "image_width: 32\n");
  expectError(open, {"camera.yaml", "image_height", "camera_calibration"});
  folder.write("camera.yaml", "{");
  expectError(open, {"camera.yaml", "not valid YAML"});
  folder.write("camera.yaml", "");
  expectError(open, {"camera.yaml", "empty"});
  folder.remove("camera.yaml");
  expectError(open, {"camera.yaml", "calibration is missing"});
  folder.write("camera.yaml", textCameraYaml("plumb_bob", ""));
  EXPECT_NO_THROW(open());

  cv::imwrite(folder.file("image/000000.png"), testImage(0, 64, 48));
  expectError(open, {"image/000000.png", "64x48", "camera.yaml", "32x24"});
  cv::imwrite(folder.file("image/000000.png"), testImage(0));

  folder.write("poses_tum.txt", "1305031102.1 0 0 0 0 0 0 1\n1305031103.1 0 0 0 0 0 0 1\n");
  expectError(open, {"poses_tum.txt", "do not meet the images'", "same clock"});
  folder.write("poses_tum.txt", "# nothing\n");
  expectError(open, {"poses_tum.txt", "holds no pose"});
}

TEST(OpenFolder, RefusesWhatIsNoSequence) {
  TemporaryFolder folder;
  expectError([&] { openFolder(folder.file("nowhere")); }, {"nowhere", "no such folder"});
  expectError([&] { openFolder(folder.path()); }, {folder.path(), "image_0", "camera.yaml"});
  folder.write("file", "");
  expectError([&] { openFolder(folder.file("file")); }, {"file", "is a file"});
  std::filesystem::create_directory(folder.file("image_0"));
  expectError([&] { openFolder(folder.path()); }, {"image_0", "holds no png"});
}

TEST(OpenFolder, OrdersNumbersAsNumbers) {
  TemporaryFolder folder;
  makeTumFolder(folder, 0);
  for (const int i : {0, 1, 2, 10, 9}) {
    cv::imwrite(folder.file("image/" + std::to_string(i) + ".png"), testImage(i));
  }
  folder.remove("poses_tum.txt");
  folder.write("times.txt", textTimes(5));
  const auto sequence = openFolder(folder.path());
  EXPECT_EQ(cv::norm(sequence->image(3), testImage(9), cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(sequence->image(4), testImage(10), cv::NORM_INF), 0);
}

TEST(RealFolders, KittiClipDoesNotStartAtTheOrigin) {
  if (realData().empty()) GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set";
  const auto sequence = openFolder(realData() + "/kitti_05_clip");
  ASSERT_EQ(sequence->size(), 60u);
  ASSERT_EQ(sequence->truth().size(), 60u);
  EXPECT_EQ(sequence->stamp_ns(1), 100'000'000);
  const auto& poses = sequence->truth().poses();
  // poses.txt: (-2.54, -2.04, 93.75) in camera axes.
  EXPECT_TRUE(poses[0].T_frame_body.translation().isApprox(
      Eigen::Vector3d(93.75397, 2.538278, 2.044394), 1e-9));
  // A car drives forward: in its own axes the first step, 0.8 m, is along +x.
  const Eigen::Vector3d step =
      (poses[0].T_frame_body.inverse() * poses[1].T_frame_body).translation();
  EXPECT_NEAR(step.x(), 0.816, 0.01);
  EXPECT_LT(step.tail<2>().norm(), 0.05);
  EXPECT_EQ(sequence->image(59).size(), cv::Size(1226, 370));
}

TEST(RealFolders, AllOpen) {
  if (realData().empty()) GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set";
  const std::pair<const char*, std::size_t> folders[] = {
      {"kitti_02_turn", 51}, {"kitti_03", 400}, {"seven_scenes_kitchen", 500}, {"euroc_still", 20}};
  for (const auto& folder : folders) {
    const auto sequence = openFolder(realData() + "/" + folder.first);
    EXPECT_EQ(sequence->size(), folder.second) << folder.first;
    EXPECT_EQ(sequence->image(0).cols, sequence->camera().width_px) << folder.first;
  }
}

}  // namespace
}  // namespace ardrone_vslam
