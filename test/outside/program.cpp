// SPDX-License-Identifier: BSD-3-Clause
// A program of somebody else's, who has the installed headers and library alone: slides sideways
// along a wall of random dots and prints the last pose.

#include <ardrone_vslam/slam.hpp>
#include <ardrone_vslam/tracker.hpp>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace ardrone_vslam;

constexpr int kWidth_px = 320, kHeight_px = 240, kWallWidth_px = 1200, kBlock_px = 6;
constexpr int kStep_px = 5;  // whole, so that the same pixels are seen again
constexpr double kFocal_px = 300, kWall_m = 3;
constexpr int kImages = 60;

std::vector<std::uint8_t> wallOfDots() {
  std::mt19937 random(1);
  std::vector<std::uint8_t> wall(kWallWidth_px * kHeight_px, 128);
  for (int y = kBlock_px; y < kHeight_px - kBlock_px; y += 2 * kBlock_px) {
    for (int x = kBlock_px; x < kWallWidth_px - kBlock_px; x += 2 * kBlock_px) {
      const int left = x + static_cast<int>(random() % kBlock_px);
      const int top = y + static_cast<int>(random() % kBlock_px);
      const auto grey = static_cast<std::uint8_t>(random() % 2 == 0 ? random() % 60 : 255);
      for (int i = 0; i < 9; ++i) wall[(top + i / 3) * kWallWidth_px + left + i % 3] = grey;
    }
  }
  return wall;
}

/// The camera looks along base's x.
Eigen::Isometry3d forwardCamera() {
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_base_cam;
}

}  // namespace

int main() {
  CameraIntrinsics camera;
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.fx_px = camera.fy_px = kFocal_px;
  camera.cx_px = (kWidth_px - 1) / 2.0;
  camera.cy_px = (kHeight_px - 1) / 2.0;
  Tracker tracker(TrackerConfig{}, camera);
  Slam slam(SlamConfig{}, forwardCamera());

  const std::vector<std::uint8_t> wall = wallOfDots();
  ImageFeatures features;
  OdometryState odometry;
  FrameResult result;
  for (int i = 0; i < kImages; ++i) {
    // To the left the wall's pixels move to the right.
    const int left_px = kWallWidth_px - kWidth_px - i * kStep_px;
    odometry.stamp_ns = 100'000'000LL * (i + 1);
    odometry.T_odom_base.translation().y() = i * kStep_px * kWall_m / kFocal_px;
    tracker.process({wall.data() + left_px, kWidth_px, kHeight_px, kWallWidth_px},
                    odometry.stamp_ns, features);
    result = slam.process(features, odometry);
  }
  const Eigen::Vector3d at = result.T_map_base.translation();
  std::printf("%d features, %d landmarks, at %.3f %.3f %.3f m: %s\n", result.features,
              result.landmarks, at.x(), at.y(), at.z(), explain(result.state));
  const bool is_well =
      result.features > 50 && result.landmarks > 20 && slam.landmarks().size() > 20;
  return is_well && (at - odometry.T_odom_base.translation()).norm() < 0.05 ? 0 : 1;
}
