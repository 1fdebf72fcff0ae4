// SPDX-License-Identifier: BSD-3-Clause
// What must not mix when the camera or the tracker is another one: maps and track ids.
#include <gtest/gtest.h>

#include "inputs/camera_identity.hpp"
#include "tracker/track_ids.hpp"

namespace ardrone_vslam {
namespace {

Features someFeatures() {
  Features features;
  features.header.frame_id = "cam";
  features.width = 640;
  features.height = 360;
  features.focal_length = 570.5F;
  return features;
}

TEST(CameraIdentity, LaterFeaturesAreOfTheSameCamera) {
  Features later = someFeatures();
  later.header.stamp = ros::Time(5);
  later.x.push_back(1);
  EXPECT_EQ(cameraOf(later), cameraOf(someFeatures()));
}

TEST(CameraIdentity, FrameSizeAndFocalLengthTellCamerasApart) {
  const CameraIdentity camera = cameraOf(someFeatures());
  Features other = someFeatures();
  other.header.frame_id = "bottom";
  EXPECT_NE(cameraOf(other), camera);
  other = someFeatures();
  other.width = 320;
  EXPECT_NE(cameraOf(other), camera);
  other = someFeatures();
  other.height = 480;
  EXPECT_NE(cameraOf(other), camera);
  other = someFeatures();
  other.focal_length = 600;
  EXPECT_NE(cameraOf(other), camera);
  EXPECT_EQ(camera.text(), "cam (640x360, focal length 570.5 px)");
}

TEST(FirstTrackId, LaterStartsLieBeyondWhatEarlierOnesUse) {
  constexpr std::uint64_t kNow_ns = 1'700'000'000'000'000'000;
  constexpr std::uint64_t kRun_ns = 60'000'000'000;
  constexpr std::uint32_t kUsed = 60 * 30 * 1500;  // 1500 new tracks in each of 30 images a second
  const std::uint32_t apart = firstTrackId(kNow_ns + kRun_ns) - firstTrackId(kNow_ns);
  EXPECT_GT(apart, kUsed);
}

TEST(FirstTrackId, IsNeverNoTrack) {
  EXPECT_NE(firstTrackId(0), kNoTrack);
  EXPECT_NE(firstTrackId(std::uint64_t{1} << 46), kNoTrack);
}

}  // namespace
}  // namespace ardrone_vslam
