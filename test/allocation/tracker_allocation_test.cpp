// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <optional>

#include "ardrone_vslam/tracker.hpp"
#include "counted_allocations.hpp"
#include "support/generated_image.hpp"
#include "support/intrinsics.hpp"

namespace ardrone_vslam {
namespace {

CameraIntrinsics camera() {
  CameraIntrinsics intrinsics = test::pinhole(640, 360, 560);
  intrinsics.k1 = -0.3;
  return intrinsics;
}

/// With hardly any contrast but in a few places.
test::TestImage dullImage(const test::TestImage& rich) {
  test::TestImage dull = rich;
  for (std::uint8_t& byte : dull.bytes) byte = static_cast<std::uint8_t>(120 + byte / 32);
  for (int i = 0; i < 12; ++i) dull.at(100 + 40 * i, 90 + 15 * i) = 255;
  return dull;
}

/// Lets a tracker see a dull scene a few times, then counts what a rich one allocates.
/// @param rotationOf  the scene's turn in frame i
template <class RotationOf>
void expectNoneAfterDullFrames(const TrackerConfig& config, const RotationOf& rotationOf) {
  static const test::TestImage rich = test::generatedImage(760, 420);
  static const test::TestImage dull = dullImage(rich);
  const test::TestImage* scene = &dull;
  constexpr int kCycle_frames = 40;
  const auto frameAt = [&scene](int i) {
    const int step = i % kCycle_frames;
    ImageView view = scene->view();
    view.data += (step % 20) * 2 * scene->stride_bytes + step * 3;
    view.width_px = camera().width_px;
    view.height_px = camera().height_px;
    return view;
  };
  Tracker tracker(config, camera());
  ImageFeatures features;
  int frame = 0;
  const auto process = [&] {
    tracker.process(frameAt(frame), frame + 1, features, {}, rotationOf(frame));
    ++frame;
  };
  while (frame < 3) process();
  EXPECT_LT(features.size(), 50U) << "not dull";
  scene = &rich;
  const long before = allocations;
  ASSERT_GT(before, 0) << "allocations are not counted";
  std::size_t found = 0;
  while (frame < 2 * kCycle_frames) {
    process();
    found += features.size();
  }
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(found, 100U * kCycle_frames) << "there was hardly anything to do";
}

std::optional<float> unknownRotation(int) {
  return std::nullopt;
}

TEST(TrackerAllocation, NoneAfterDullFrames) {
  expectNoneAfterDullFrames({}, unknownRotation);
}

TEST(TrackerAllocation, NoneWithAttitudeThatComesAndGoes) {
  TrackerConfig config;
  config.use_attitude = true;
  expectNoneAfterDullFrames(config, [](int frame) -> std::optional<float> {
    if (frame % 3 == 0) return std::nullopt;
    return 0.1F * static_cast<float>(frame % 60) - 3.F;
  });
}

TEST(TrackerAllocation, NoneWithFewerPassesOrStrictSuppression) {
  for (const int passes : {1, 3, 8, 16}) {
    for (const Suppression suppression : {Suppression::kLocalClimb, Suppression::kStrict3x3}) {
      SCOPED_TRACE(passes);
      TrackerConfig config;
      config.corners.sampling_passes = passes;
      config.corners.suppression = suppression;
      expectNoneAfterDullFrames(config, unknownRotation);
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
