// SPDX-License-Identifier: BSD-3-Clause
#include "world/live_camera.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "support/worlds.hpp"

namespace ardrone_vslam {
namespace {

using test::room;

CameraShot shotAt(std::int64_t stamp_ns) {
  FlightState state;
  state.T_world_body.translation().z() = 1;
  CameraShot shot;
  shot.stamp_ns = stamp_ns;
  shot.camera = "front";
  shot.motion = pathThrough(state, cameraNamed("front").T_body_cam);
  shot.seed = 7;
  return shot;
}

CameraShot waitFor(LiveCamera& camera, std::int64_t now_ns) {
  for (int i = 0; i < 6000; ++i) {
    if (auto shot = camera.take(now_ns)) return *shot;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error("no image within a minute");
}

TEST(LiveCamera, TakesThePictureOfWorldCameraAndHandsItOverAtItsStamp) {
  LiveCamera camera(room(), {}, {"front"});
  const CameraShot asked = shotAt(100);
  camera.shoot(asked);
  while (camera.counts().rendered == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(camera.take(99)) << "it is not received yet";
  const CameraShot taken = waitFor(camera, 100);
  EXPECT_EQ(taken.stamp_ns, 100);
  const cv::Mat expected = WorldCamera(cameraNamed("front").intrinsics, {})
                               .shoot(room().at(0), asked.motion, asked.seed);
  EXPECT_EQ(cv::countNonZero(taken.image != expected), 0);
  EXPECT_FALSE(camera.take(1000));
}

TEST(LiveCamera, LosesImagesInsteadOfQueueingThem) {
  LiveCamera camera(room(), {}, {"front"});
  constexpr int kShots = 100;
  for (int i = 0; i < kShots; ++i) camera.shoot(shotAt(i));
  CameraShot taken = waitFor(camera, kShots);
  while (taken.stamp_ns != kShots - 1) {
    const std::int64_t before_ns = taken.stamp_ns;
    taken = waitFor(camera, kShots);
    EXPECT_GT(taken.stamp_ns, before_ns);
  }
  const LiveCamera::Counts counts = camera.counts();
  EXPECT_GT(counts.lost, 0U);
  EXPECT_EQ(counts.rendered + counts.lost, kShots);
  EXPECT_GT(counts.render_ms, 0);
}

TEST(LiveCamera, EndsWhileItRenders) {
  LiveCamera camera(room(), {}, {"front", "bottom"});
  camera.shoot(shotAt(1));
}

TEST(LiveCamera, RefusesAnUnknownCamera) {
  EXPECT_THROW(LiveCamera(room(), {}, {"rear"}), std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
