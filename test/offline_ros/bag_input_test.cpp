// SPDX-License-Identifier: BSD-3-Clause
// What is in other people's bags: other types and encodings, and everything that can be wrong.

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/String.h>

#include <iterator>
#include <limits>

#include "bag_recipe.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expectWarning(const BagSequence& sequence, const std::vector<std::string>& parts) {
  ASSERT_EQ(sequence.findings().warnings.size(), 1u);
  for (const auto& part : parts) {
    EXPECT_NE(sequence.findings().warnings[0].find(part), std::string::npos)
        << sequence.findings().warnings[0];
  }
}

TEST(BagInput, SoundBag) {
  const TestBag bag{BagRecipe()};
  const auto sequence = bag.open();
  EXPECT_TRUE(sequence->findings().warnings.empty());
  ASSERT_EQ(sequence->size(), 4u);
  EXPECT_EQ(sequence->stamp_ns(2), 1'200'000'000);
  EXPECT_EQ(sequence->camera().k1, -0.5);
  EXPECT_TRUE(sequence->T_base_cam().isApprox(Eigen::Translation3d(0.2, 0, 0) * forwardCamera()));
  ASSERT_EQ(sequence->odometry().size(), 5u);
  EXPECT_EQ(sequence->odometry()[2].T_odom_base.translation().x(), 1.0);
  EXPECT_EQ(sequence->odometry()[2].covariance(0, 0), 0.25);
  EXPECT_EQ(sequence->odometry()[2].covariance(5, 5), 0.5);
}

TEST(BagInput, EveryEncodingGivesGrey) {
  for (const std::string encoding : {"mono8", "8UC1", "mono16", "rgb8", "bgr8"}) {
    BagRecipe recipe;
    recipe.encoding = encoding;
    const TestBag bag(recipe);
    const cv::Mat image = bag.open()->image(1);
    EXPECT_EQ(image.type(), CV_8UC1) << encoding;
    EXPECT_LE(cv::norm(image, testImage(1), cv::NORM_INF), 1) << encoding;
  }
  for (const std::string encoding : {"bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8"}) {
    BagRecipe recipe;
    recipe.encoding = encoding;
    const TestBag bag(recipe);
    const cv::Mat image = bag.open()->image(1);
    EXPECT_EQ(image.type(), CV_8UC1) << encoding;
    EXPECT_EQ(image.size(), cv::Size(32, 24)) << encoding;
  }
}

TEST(BagInput, UnknownEncodingIsNamed) {
  BagRecipe recipe;
  recipe.encoding = "yuv422";
  TestBag(recipe).expectRefused({"test.bag", "/cam/image", "'yuv422'", "mono8", "convert"});
}

TEST(BagInput, LensModels) {
  for (const std::string model : {"rational_polynomial", "equidistant"}) {
    BagRecipe recipe;
    recipe.camera_info.distortion_model = model;
    recipe.camera_info.D.assign(8, 0.1);
    TestBag(recipe).expectRefused(
        {"/cam/camera_info", "'" + model + "'", "is not supported", "plumb_bob"});
  }
  BagRecipe uncalibrated;
  uncalibrated.camera_info.K.fill(0);
  TestBag(uncalibrated).expectRefused({"/cam/camera_info", "uncalibrated", "camera_calibration"});
  BagRecipe too_few;
  too_few.camera_info.D.assign(2, 0.0);
  TestBag(too_few).expectRefused({"/cam/camera_info", "D has 2 values"});
  BagRecipe binned;
  binned.camera_info.binning_x = 2;
  TestBag(binned).expectRefused({"/cam/camera_info", "binning"});
  BagRecipe cropped;
  cropped.camera_info.roi.width = 16;
  TestBag(cropped).expectRefused({"/cam/camera_info", "region of interest"});
  BagRecipe as_plumb_bob;
  as_plumb_bob.camera_info.distortion_model = "rational_polynomial";
  as_plumb_bob.camera_info.D.resize(8, 0.0);
  EXPECT_EQ(TestBag(as_plumb_bob).open()->camera().k1, -0.5);
  BagRecipe without_lens;
  without_lens.camera_info.distortion_model.clear();
  without_lens.camera_info.D.clear();
  EXPECT_EQ(TestBag(without_lens).open()->camera().k1, 0);
}

TEST(BagInput, RectifiedImagesHaveTheProjectionMatrix) {
  BagRecipe recipe;
  recipe.camera_info.P[0] = 18;
  const TestBag bag(recipe);
  EXPECT_EQ(bag.open()->camera().fx_px, 20);
  BagReadOptions options;
  options.rectified = true;
  const CameraIntrinsics camera = bag.open(options)->camera();
  EXPECT_EQ(camera.fx_px, 18);
  EXPECT_EQ(camera.k1, 0);
}

TEST(BagInput, CalibrationMissingOrGivenOtherwise) {
  BagRecipe recipe;
  recipe.has_camera_info = false;
  const TestBag bag(recipe);
  bag.expectRefused({"test.bag", "calibration", "/cam/camera_info", "--camera",
                     "/cam/image (sensor_msgs/Image)"});
  BagReadOptions options;
  options.camera = intrinsicsFromCameraInfo(recipe.camera_info, "");
  EXPECT_EQ(bag.open(options)->size(), 4u);
}

TEST(BagInput, SizeUnlikeTheCalibration) {
  BagRecipe recipe;
  recipe.size_px = {40, 24};
  TestBag(recipe).expectRefused({"/cam/image", "40x24", "32x24", "calibration"});
  const TestBag mixed(BagRecipe(), [&recipe](rosbag::Bag& bag) {
    auto message = imageMessage(recipe, 0);
    message.header.stamp = ros::Time(1.25);
    bag.write("/cam/image", ros::Time(1.005), message);
  });
  const auto sequence = mixed.open();
  EXPECT_EQ(sequence->size(), 4u);
  expectWarning(*sequence, {"/cam/image", "1 images", "40x24"});
}

TEST(BagInput, IncompleteImagesAndBackwardStampsAreDroppedAndCounted) {
  BagRecipe recipe;
  recipe.image_stamps_s = {1.0, 1.1, 1.05, 1.1, 1.2};
  const TestBag backward(recipe);
  const auto sequence = backward.open();
  ASSERT_EQ(sequence->size(), 4u);
  EXPECT_EQ(cv::norm(sequence->image(3), testImage(4), cv::NORM_INF), 0);
  expectWarning(*sequence, {"/cam/image", "1 images", "out of order"});

  recipe.image_stamps_s = {0, 0, 0};
  TestBag(recipe).expectRefused({"/cam/image", "no image can be used", "3 images have no stamp"});

  const TestBag incomplete(BagRecipe(), [](rosbag::Bag& bag) {
    auto message = imageMessage(BagRecipe(), 0);
    message.header.stamp = ros::Time(9);
    message.data.resize(100);
    bag.write("/cam/image", ros::Time(9), message);
  });
  expectWarning(*incomplete.open(), {"/cam/image", "1 images are incomplete"});
}

TEST(BagInput, OneStampFarAheadTakesNothingAlong) {
  BagRecipe recipe;
  recipe.image_stamps_s = {1.0, 1001, 1.1, 1.2, 1.3};
  recipe.odometry[2].header.stamp += ros::Duration(1000);
  sensor_msgs::Range range;
  range.range = range.max_range = 1;
  const auto withTruthAndRanges = [&](rosbag::Bag& more) {
    ros::Time recorded(2);
    for (const double stamp_s : {1.0, 1.1, 1001.2, 1.3, 1.4}) {
      recorded += ros::Duration(0.1);
      range.header.stamp = ros::Time(stamp_s);
      more.write("/range", recorded, range);
      geometry_msgs::PoseStamped truth;
      truth.header.stamp = range.header.stamp;
      truth.pose.orientation.w = 1;
      more.write("/ground_truth", recorded, truth);
    }
  };
  BagReadOptions options;
  options.use_range = true;
  const auto sequence = TestBag(recipe, withTruthAndRanges).open(options);
  EXPECT_EQ(sequence->size(), 4U);
  EXPECT_EQ(sequence->odometry().size(), 4U);
  EXPECT_EQ(sequence->ranges().size(), 4U);
  EXPECT_EQ(sequence->truth().size(), 4U);
  EXPECT_EQ(sequence->findings().warnings.size(), 4U);
  // One of five is more than 5 %.
  EXPECT_TRUE(sequence->findings().has_lost_much);
}

TEST(BagInput, AFewLostMessagesAreNoReasonToFail) {
  BagRecipe recipe;
  for (int i = 0; i < 15; ++i)
    recipe.odometry.push_back(BagRecipe::odometryAt(1.5 + 0.1 * i, 2.5 + 0.5 * i));
  recipe.odometry[7].header.stamp += ros::Duration(1000);
  EXPECT_FALSE(TestBag(recipe).open()->findings().has_lost_much);
  recipe.odometry[9].pose.pose.position.x = kNan;
  recipe.odometry[11].pose.pose.position.x = kNan;
  EXPECT_TRUE(TestBag(recipe).open()->findings().has_lost_much);
}

TEST(BagInput, HalfACompressedImageIsDroppedAndCounted) {
  const TestBag bag(BagRecipe(), [](rosbag::Bag& more) {
    sensor_msgs::CompressedImage message;
    message.header.frame_id = "cam";
    for (const double stamp_s : {1.0, 1.1, 1.2}) {
      message.header.stamp = ros::Time(stamp_s);
      cv::imencode(".jpg", testImage(0), message.data);
      if (stamp_s == 1.1) message.data.resize(message.data.size() - 20);
      more.write("/other/image/compressed", message.header.stamp, message);
    }
    more.write("/other/camera_info", ros::Time(1), BagRecipe().camera_info);
  });
  BagReadOptions options;
  options.image_topic = "/other/image/compressed";
  const auto sequence = bag.open(options);
  EXPECT_EQ(sequence->size(), 2u);
  expectWarning(*sequence,
                {"/other/image/compressed", "1 images are incomplete or cannot be decoded"});
}

TEST(BagInput, OdometryThatIsWrongIsDroppedAndCounted) {
  BagRecipe recipe;
  recipe.odometry[1].pose.pose.position.y = kNan;
  recipe.odometry[2].pose.pose.orientation.w = 0;
  const TestBag not_finite(recipe);
  const auto sequence = not_finite.open();
  EXPECT_EQ(sequence->odometry().size(), 3u);
  expectWarning(*sequence, {"/odom", "2 messages dropped", "not finite"});

  // The nodelets drop these, too.
  recipe = BagRecipe();
  recipe.odometry[1].twist.twist.linear.z = kNan;
  recipe.odometry[2].twist.twist.angular.x = std::numeric_limits<double>::infinity();
  recipe.odometry[4].twist.covariance[7] = kNan;
  const auto without_twist = TestBag(recipe).open();
  EXPECT_EQ(without_twist->odometry().size(), 2u);
  expectWarning(*without_twist, {"/odom", "3 messages dropped", "twist", "not finite"});

  recipe = BagRecipe();
  recipe.odometry[2].header.stamp = ros::Time(0.5);
  recipe.odometry[3].header.stamp = recipe.odometry[1].header.stamp;  // a burst: kept
  const auto backward = TestBag(recipe).open();
  EXPECT_EQ(backward->odometry().size(), 4u);
  expectWarning(*backward, {"/odom", "1 messages dropped", "goes back"});

  recipe = BagRecipe();
  recipe.odometry[3].pose.pose.position.z = -1e300;
  const auto far = TestBag(recipe).open();
  EXPECT_EQ(far->odometry().size(), 4u);
  expectWarning(*far, {"/odom", "1 messages dropped", "more than 1e7 m"});

  recipe = BagRecipe();
  recipe.odometry[3].pose.pose.orientation.w *= 1.05;  // few digits, as the nodelets: kept
  recipe.odometry[4].pose.pose.orientation.w *= 1.5;
  const auto skewed = TestBag(recipe).open();
  EXPECT_EQ(skewed->odometry().size(), 4u);
  expectWarning(*skewed, {"/odom", "1 messages dropped", "has norm 1.5"});

  recipe = BagRecipe();
  for (auto& message : recipe.odometry) message.pose.pose.position.x = 3;
  expectWarning(*TestBag(recipe).open(), {"/odom", "5 poses are equal", "zero odometry"});
}

TEST(BagInput, ACovarianceThatCountsAsNotGivenIsToldOnce) {
  BagRecipe recipe;
  for (auto& message : recipe.odometry) message.pose.covariance[0] = -1;
  const auto negative = TestBag(recipe).open();
  EXPECT_EQ(negative->odometry().size(), 5u);
  expectWarning(*negative, {"/odom", "variance of -1 m^2", "counts as not given"});
  for (auto& message : recipe.odometry) message.pose.covariance.assign(0);  // the usual "none"
  EXPECT_TRUE(TestBag(recipe).open()->findings().warnings.empty());
}

TEST(BagInput, AMountingThatCannotBeIsRefusedWithTheBagsName) {
  BagRecipe recipe;
  recipe.has_tf = false;
  Eigen::Isometry3d T_base_cam = forwardCamera();
  T_base_cam.translation().y() = -101;
  const TestBag bag(recipe, [&](rosbag::Bag& opened) {
    tf2_msgs::TFMessage tf;
    tf.transforms = {toTransformMessage(T_base_cam, ros::Time(1.0), "base", "cam")};
    opened.write("/tf", ros::Time(1.0), tf);
  });
  bag.expectRefused({bag.path(), "'base'", "'cam'", "101 m from base", "beyond 100 m"});
}

TEST(BagInput, ATransformThatIsNoneCountsAsNotThereWithoutLinesOfTf) {
  BagRecipe recipe;
  recipe.has_tf = false;
  const TestBag bag(recipe, [&](rosbag::Bag& opened) {
    tf2_msgs::TFMessage tf;
    tf.transforms = {toTransformMessage(forwardCamera(), ros::Time(1.0), "base", "cam")};
    for (const double w : {0.0, std::nan("")}) {
      tf.transforms[0].transform.rotation = geometry_msgs::Quaternion();
      tf.transforms[0].transform.rotation.w = w;
      for (int i = 0; i < 100; ++i) opened.write("/tf", ros::Time(1.0), tf);
    }
  });
  testing::internal::CaptureStderr();
  bag.expectRefused({bag.path(), "'base'", "'cam'", "/tf_static"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(BagInput, NoTransformToTheCamera) {
  BagRecipe recipe;
  recipe.has_tf = false;
  const TestBag bag(recipe);
  bag.expectRefused({"test.bag", "'base'", "'cam'", "/tf_static", "--base-frame"});
  BagReadOptions options;
  options.T_base_cam = forwardCamera();
  EXPECT_TRUE(bag.open(options)->T_base_cam().isApprox(forwardCamera()));
  options = BagReadOptions();
  options.base_frame = "body";
  TestBag{BagRecipe()}.expectRefused({"'body'", "'cam'"}, options);
  options.base_frame = "mount";
  EXPECT_TRUE(TestBag{BagRecipe()}.open(options)->T_base_cam().isApprox(forwardCamera()));
}

TEST(BagInput, OdometryThatDoesNotNameItsBaseIsRefusedAsByTheMapper) {
  BagRecipe recipe;
  for (auto& message : recipe.odometry) message.child_frame_id.clear();
  const TestBag bag(recipe);
  bag.expectRefused({"test.bag, /odom", "no child_frame_id", "--base-frame", "mapper/base_frame"});
  BagReadOptions options;
  options.base_frame = "mount";
  EXPECT_TRUE(bag.open(options)->T_base_cam().isApprox(forwardCamera()));
  recipe.odometry.clear();
  EXPECT_TRUE(TestBag(recipe).open()->T_base_cam().isApprox(forwardCamera()))
      << "without odometry base is the camera's parent";
}

TEST(BagInput, TopicsMissingSeveralOrOfAnotherType) {
  const TestBag bag(BagRecipe(), [](rosbag::Bag& more) {
    auto image = imageMessage(BagRecipe(), 0);
    more.write("/other/image", ros::Time(2), image);
    more.write("/other_odom", ros::Time(2), BagRecipe::odometryAt(2, 0));
  });
  bag.expectRefused({"several topics", "/cam/image, /other/image", "--image-topic"});
  BagReadOptions options;
  options.image_topic = "/cam/image";
  bag.expectRefused({"several topics", "/odom, /other_odom", "--odometry-topic"}, options);
  options.odometry_topic = "odom";
  EXPECT_EQ(bag.open(options)->odometry().size(), 5u);
  options.odometry_topic = "/odometry";
  bag.expectRefused({"no topic /odometry", "Topics there", "/odom (nav_msgs/Odometry)"}, options);
  options.odometry_topic = "/cam/image";
  bag.expectRefused({"/cam/image is sensor_msgs/Image", "nav_msgs/Odometry"}, options);
}

TEST(BagInput, TruthOfEveryType) {
  geometry_msgs::PoseStamped stamped;
  stamped.header.stamp = ros::Time(1.0);
  stamped.pose.position.x = 4;
  stamped.pose.orientation.w = 1;
  geometry_msgs::PoseWithCovarianceStamped with_covariance;
  with_covariance.header = stamped.header;
  with_covariance.pose.pose = stamped.pose;
  nav_msgs::Odometry odometry = BagRecipe::odometryAt(1.0, 4);
  const auto check = [](const auto& message) {
    const TestBag bag(BagRecipe(), [&message](rosbag::Bag& more) {
      more.write("/ground_truth", ros::Time(2), message);
      more.write("/ground_truth", ros::Time(2.1), message);  // the same stamp: dropped
    });
    const auto sequence = bag.open();
    ASSERT_EQ(sequence->truth().size(), 1u);
    EXPECT_EQ(sequence->truth().poses()[0].stamp_ns, 1'000'000'000);
    EXPECT_EQ(sequence->truth().poses()[0].T_frame_body.translation().x(), 4);
    EXPECT_EQ(sequence->odometry().size(), 5u);
    expectWarning(*sequence, {"/ground_truth", "1 messages dropped", "goes back"});
  };
  check(stamped);
  check(with_covariance);
  check(odometry);
}

TEST(BagInput, NoBagAtAll) {
  TemporaryFolder folder;
  const std::string path = folder.file("x.bag");
  const auto open = [&path] { openBag(path, {}); };
  expectError(open, {"x.bag", "no such file"});
  folder.write("x.bag", "");
  expectError(open, {"x.bag", "empty", "record it again"});
  folder.write("x.bag", "this is a text");
  expectError(open, {"x.bag", "no readable bag", "rosbag reindex"});
  rosbag::Bag(path, rosbag::bagmode::Write).close();
  expectError(open, {"x.bag", "no message", "rosbag reindex"});
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.write("/text", ros::Time(1), std_msgs::String());
  }
  expectError(open, {"x.bag", "images", "/text (std_msgs/String)", "record the camera"});
}

TEST(BagInput, ABagCutOffAnywhereIsRefusedWithTheRemedy) {
  const TestBag bag{BagRecipe()};
  std::ifstream file(bag.path(), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  TemporaryFolder folder;
  for (std::size_t size = 1; size < whole.size(); size += 97) {
    folder.write("cut.bag", whole.substr(0, size));
    expectError([&folder] { openBag(folder.file("cut.bag"), {}); }, {"cut.bag", "rosbag reindex"});
  }
}

}  // namespace
}  // namespace ardrone_vslam
