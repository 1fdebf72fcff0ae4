// SPDX-License-Identifier: BSD-3-Clause
// Bags in whose image topic two cameras take turns.
#include <gtest/gtest.h>

#include "bag_recipe.hpp"
#include "driver_recording.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {
namespace {

/// Image `index` of the recipe, by another camera that is mounted at the same place.
sensor_msgs::Image otherImage(const BagRecipe& recipe, int index, double stamp_s) {
  sensor_msgs::Image image = imageMessage(recipe, index);
  image.header.stamp = ros::Time(stamp_s);
  image.header.frame_id = "other";
  return image;
}

sensor_msgs::CameraInfo infoOf(const BagRecipe& recipe, const std::string& frame, double f_px) {
  sensor_msgs::CameraInfo info = recipe.camera_info;
  info.header.frame_id = frame;
  info.K[0] = f_px;
  return info;
}

tf2_msgs::TFMessage otherMounting() {
  tf2_msgs::TFMessage tf;
  Eigen::Isometry3d T_base_other = Eigen::Isometry3d::Identity();
  T_base_other.translation().y() = -0.5;
  tf.transforms = {toTransformMessage(T_base_other, ros::Time(1.0), "base", "other")};
  return tf;
}

TEST(BagCameras, TheDriversTogglecamIsTwoCameras) {
  const DriverRecording recording({DriverFault::kTogglecam});
  const auto bag = openBag(recording.path(), {});  // /ardrone/image_raw, of whichever streams
  ASSERT_GE(bag->size(), 5U);
  const std::size_t front = bag->cameraOf(0);
  const std::size_t bottom = bag->cameraOf(bag->size() / 2);
  EXPECT_NE(front, bottom);
  EXPECT_EQ(bag->cameraOf(bag->size() - 1), front);
  EXPECT_NEAR(bag->cameraAt(front).T_base_cam.translation().x(), 0.21, 1e-9);
  EXPECT_NEAR(bag->cameraAt(bottom).T_base_cam.translation().y(), -0.02, 1e-9);
  // It looks down.
  EXPECT_LT((bag->cameraAt(bottom).T_base_cam.linear() * Eigen::Vector3d::UnitZ()).z(), -0.99);
  EXPECT_FALSE(bag->cameraAt(front).intrinsics == bag->cameraAt(bottom).intrinsics);
  EXPECT_TRUE(bag->camera() == bag->cameraAt(front).intrinsics);
}

TEST(BagCameras, EachFrameHasItsCalibrationAndMounting) {
  BagRecipe recipe;
  recipe.camera_info.header.frame_id = "cam";
  const TestBag test_bag(recipe, [&](rosbag::Bag& bag) {
    bag.write("/cam/image", ros::Time(2.0), otherImage(recipe, 0, 1.35));
    bag.write("/cam/camera_info", ros::Time(2.0), infoOf(recipe, "other", 30));
    bag.write("/tf", ros::Time(2.1), otherMounting());
  });
  const auto bag = test_bag.open();
  ASSERT_EQ(bag->size(), 5U);
  EXPECT_EQ(bag->camera().fx_px, 20);
  const SequenceCamera other = bag->cameraAt(bag->cameraOf(4));
  EXPECT_EQ(other.intrinsics.fx_px, 30);
  EXPECT_EQ(other.T_base_cam.translation().y(), -0.5);
  EXPECT_TRUE(bag->findings().warnings.empty());
}

TEST(BagCameras, ImagesWithoutCalibrationAreNamedAndLeftOut) {
  BagRecipe recipe;
  recipe.camera_info.header.frame_id = "cam";
  const TestBag test_bag(recipe, [&](rosbag::Bag& bag) {
    bag.write("/cam/image", ros::Time(2.0), otherImage(recipe, 0, 1.35));
    bag.write("/tf", ros::Time(2.1), otherMounting());
  });
  const auto bag = test_bag.open();
  EXPECT_EQ(bag->size(), 4U);
  ASSERT_EQ(bag->findings().warnings.size(), 1U);
  for (const char* part : {"/cam/image", "1 images", "other", "no calibration", "camera_info"})
    EXPECT_NE(bag->findings().warnings[0].find(part), std::string::npos)
        << bag->findings().warnings[0];
}

TEST(BagCameras, AMountingThatIsMissingIsNamed) {
  BagRecipe recipe;
  recipe.camera_info.header.frame_id = "cam";
  const TestBag test_bag(recipe, [&](rosbag::Bag& bag) {
    bag.write("/cam/image", ros::Time(2.0), otherImage(recipe, 0, 1.35));
    bag.write("/cam/camera_info", ros::Time(2.0), infoOf(recipe, "other", 30));
  });
  test_bag.expectRefused({"tf", "other"});
}

}  // namespace
}  // namespace ardrone_vslam
