// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/reference_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "matching/hamming.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr float kFocalLength_px = 570;
constexpr int kCorners = 400;

/// Corners anywhere in an image, some near each other with descriptors that are alike.
ImageFeatures cornersOf(RandomSource& random) {
  ImageFeatures features;
  features.focal_length_px = kFocalLength_px;
  for (int i = 0; i < kCorners; ++i) {
    const Eigen::Vector3d ray(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), 1);
    features.pixel_px.emplace_back(0.F, 0.F);
    features.bearing_cam.push_back(ray.normalized().cast<float>());
    features.track_id.push_back(static_cast<std::uint32_t>(i + 1));
    Descriptor descriptor;
    descriptor.words[0] = (1ULL << (i % 8)) - 1;
    features.descriptor.push_back(descriptor);
  }
  return features;
}

/// The same corners a little further, turned; of many the track has begun anew.
ImageFeatures laterOf(ImageFeatures features, const Eigen::Matrix3d& R_reference_now,
                      RandomSource& random) {
  std::uint32_t next_id = kCorners + 1;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Eigen::Vector3d moved =
        features.bearing_cam[i].cast<double>() + 5 / kFocalLength_px * random.normal3();
    features.bearing_cam[i] = (R_reference_now.transpose() * moved).normalized().cast<float>();
    if (random.chance(0.7)) features.track_id[i] = next_id++;
    features.descriptor[i].words[7] = (1ULL << static_cast<int>(random.uniform(0, 60))) - 1;
  }
  return features;
}

/// Corners of the reference by the track that holds them in the later image.
using Held = std::vector<std::pair<std::uint32_t, Eigen::Vector3d>>;

/// All compared with all.
Held expectedOf(const ImageFeatures& reference, const ImageFeatures& later,
                const Eigen::Matrix3d& R_reference_now) {
  Held held;
  std::vector<std::size_t> lost;
  const auto holds = [](const ImageFeatures& features, std::uint32_t id) {
    return std::count(features.track_id.begin(), features.track_id.end(), id) > 0;
  };
  for (std::size_t c = 0; c < reference.size(); ++c) {
    if (!holds(later, reference.track_id[c])) lost.push_back(c);
  }
  for (std::size_t i = 0; i < later.size(); ++i) {
    if (holds(reference, later.track_id[i])) continue;
    const Eigen::Vector3d bearing = R_reference_now * later.bearing_cam[i].cast<double>();
    auto best = lost.end();
    int fewest = 90;
    for (auto c = lost.begin(); c != lost.end(); ++c) {
      const double away_rad =
          std::acos(std::min(bearing.dot(reference.bearing_cam[*c].cast<double>()), 1.0));
      const int bits = hammingDistance(later.descriptor[i], reference.descriptor[*c]);
      if (away_rad > 10 * kCornerJump_px / kFocalLength_px || bits >= fewest) continue;
      fewest = bits;
      best = c;
    }
    if (best == lost.end()) continue;
    held.emplace_back(later.track_id[i], reference.bearing_cam[*best].cast<double>());
    lost.erase(best);
  }
  return held;
}

TEST(ReferenceImage, FindsAgainWhatAComparisonOfAllWithAllFinds) {
  RandomSource random(5);
  std::size_t found = 0;
  for (int round = 0; round < 20; ++round) {
    const ImageFeatures before = cornersOf(random);
    const Eigen::Matrix3d R_reference_now = rotationOf(0.1 * random.normal3());
    const ImageFeatures later = laterOf(before, R_reference_now, random);
    ReferenceImage reference;
    reference.take(before);
    const auto held = reference.pairsWith(later);
    reference.findAgain(later, R_reference_now);
    const Held expected = expectedOf(before, later, R_reference_now);
    EXPECT_EQ(reference.pairsWith(later).size(), held.size() + expected.size());
    for (const auto& [track_id, bearing] : expected) {
      ImageFeatures one;
      one.pixel_px.emplace_back(0.F, 0.F);
      one.bearing_cam.emplace_back(0.F, 0.F, 1.F);
      one.track_id.push_back(track_id);
      const auto pairs = reference.pairsWith(one);
      ASSERT_EQ(pairs.size(), 1U) << "track " << track_id;
      EXPECT_EQ(pairs[0].then, bearing);
    }
    found += expected.size();
  }
  EXPECT_GT(found, 20 * kCorners / 3) << "the images have something to find";
}

}  // namespace
}  // namespace ardrone_vslam
