// SPDX-License-Identifier: BSD-3-Clause
#include "window/track_window.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kCornerSigma_px = 0.5;
constexpr double kSceneSigma_px = 0.2;

/// One image after the other, with the window's frames that they belong to.
struct Images {
  std::vector<Clone> frames;
  TrackWindow window{Eigen::Matrix3d::Identity(), kCornerSigma_px, kSceneSigma_px};
  ImageFeatures features;
  TrackOrder order;

  void show(const std::vector<std::uint32_t>& track_ids, float shift = 0) {
    features = {};
    features.focal_length_px = 100;
    for (const std::uint32_t id : track_ids) {
      features.pixel_px.emplace_back(0, 0);
      features.bearing_cam.push_back(
          Eigen::Vector3f(0.01F * static_cast<float>(id) + shift, 0, 1).normalized());
      features.track_id.push_back(id);
      features.descriptor.emplace_back();
      features.descriptor.back().words[0] = 1000 * frames.size() + id;
    }
    order.reset(features);
    Clone pose;
    pose.id = frames.empty() ? 1 : frames.back().id + 1;
    frames.push_back(pose);
  }
  void add(const std::vector<std::uint32_t>& track_ids) {
    show(track_ids);
    window.add(frames.back().id, features, order);
  }
  void dropOldest() {
    window.dropFrame(frames.front().id);
    frames.erase(frames.begin());
  }
};

std::vector<std::uint32_t> idsOf(const std::vector<FinishedTrack>& tracks) {
  std::vector<std::uint32_t> ids;
  for (const FinishedTrack& track : tracks) ids.push_back(track.track_id);
  return ids;
}

std::vector<std::size_t> framesOf(const FinishedTrack& track) {
  std::vector<std::size_t> frames;
  for (const TrackView& view : track.views) frames.push_back(view.frame);
  return frames;
}

TEST(TrackOrder, AscendsAndLeavesOutFeaturesWithoutATrack) {
  ImageFeatures features;
  features.track_id = {7, kNoTrack, 3, 9};
  features.pixel_px.resize(4);
  TrackOrder order;
  order.reset(features);
  std::vector<std::uint32_t> ids;
  for (const TrackedFeature& entry : order) ids.push_back(entry.track_id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{3, 7, 9}));
  ASSERT_NE(order.find(9), nullptr);
  EXPECT_EQ(order.find(9)->feature, 3U);
  EXPECT_EQ(order.find(4), nullptr);
  EXPECT_EQ(order.find(10), nullptr);
}

TEST(TrackWindow, TracksThatEndedAreTakenOutOnceWithAllTheirViews) {
  Images images;
  images.add({5, 2, 8});
  images.add({8, 5});
  images.window.assignLandmark(5, 77);
  images.window.assignLandmark(6, 78);  // unknown: ignored
  images.add({8});
  const auto& finished = images.window.takeFinished(images.frames, false);
  ASSERT_EQ(idsOf(finished), (std::vector<std::uint32_t>{2, 5}));
  EXPECT_EQ(framesOf(finished[0]), (std::vector<std::size_t>{0}));
  EXPECT_EQ(framesOf(finished[1]), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(finished[1].landmark_id, 77U);
  EXPECT_EQ(finished[1].descriptor.words[0], 1005U) << "of its last view";
  EXPECT_TRUE(images.window.takeFinished(images.frames, false).empty());
}

TEST(TrackWindow, ATrackThatSpansTheWindowIsOfferedAndGoesOnFromItsNewestView) {
  Images images;
  images.add({1});
  images.add({1, 2});
  images.add({1, 2});
  const auto& finished = images.window.takeFinished(images.frames, true);
  ASSERT_EQ(idsOf(finished), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(framesOf(finished[0]), (std::vector<std::size_t>{0, 1, 2}));
  images.window.keepNewestView(1);
  images.dropOldest();
  images.add({2});
  const auto& ended = images.window.takeFinished(images.frames, false);
  ASSERT_EQ(idsOf(ended), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(framesOf(ended[0]), (std::vector<std::size_t>{1})) << "the others have been used";
}

TEST(TrackWindow, TheMotionIsTheMedianOfTheCommonTracks) {
  Images images;
  images.add({1, 2, 3, 4});
  images.show({9, 3, 2, 1}, 0.05F);
  const auto motion =
      images.window.motionSince(images.frames[0], images.frames[1], images.features, images.order);
  EXPECT_EQ(motion.common, 3);
  EXPECT_EQ(motion.lost, 1);
  EXPECT_NEAR(motion.median_px, 5, 0.1);
}

/// The same by the obvious container.
TEST(TrackWindow, KeepsEveryViewOfRandomTracks) {
  RandomSource random(3);
  const auto chance = [&](double share) { return std::abs(random.normal()) < share; };
  Images images;
  std::map<std::uint32_t, std::vector<std::uint32_t>> views;  // frames by track
  std::vector<std::uint32_t> alive;
  std::uint32_t next_id = 1;
  for (int round = 0; round < 200; ++round) {
    alive.erase(std::remove_if(alive.begin(), alive.end(), [&](auto) { return chance(0.2); }),
                alive.end());
    while (alive.size() < 30) alive.insert(alive.begin(), next_id++);
    images.add(alive);
    const std::uint32_t newest = images.frames.back().id;
    for (const std::uint32_t id : alive) views[id].push_back(newest);

    const bool is_full = images.frames.size() > 6;
    std::vector<std::uint32_t> expected;
    for (const auto& [id, its_frames] : views) {
      if (its_frames.back() != newest || (is_full && its_frames.front() == images.frames[0].id))
        expected.push_back(id);
    }
    const auto& finished = images.window.takeFinished(images.frames, is_full);
    ASSERT_EQ(idsOf(finished), expected);
    for (const FinishedTrack& track : finished) {
      auto& its_frames = views[track.track_id];
      ASSERT_EQ(track.views.size(), its_frames.size());
      for (std::size_t i = 0; i < its_frames.size(); ++i)
        EXPECT_EQ(images.frames[track.views.begin()[i].frame].id, its_frames[i]);
      const bool has_ended = its_frames.back() != newest;
      if (has_ended) {
        views.erase(track.track_id);
      } else if (chance(0.7)) {
        images.window.keepNewestView(track.track_id);
        its_frames = {newest};
      }
    }
    if (!is_full) continue;
    for (auto& [id, its_frames] : views) {
      if (its_frames.front() == images.frames[0].id) its_frames.erase(its_frames.begin());
    }
    images.dropOldest();
  }
}

/// Sigma of the only view's ray along the image's columns and rows [px].
Eigen::Vector2d sigmas_px(Images& images) {
  const auto& finished = images.window.takeFinished(images.frames, true);
  const RayRoot& root = finished.at(0).views.front().root_rig;
  const Eigen::Matrix2d information = (root.transpose() * root).topLeftCorner<2, 2>();
  return images.features.focal_length_px * information.inverse().diagonal().cwiseSqrt();
}

TEST(TrackWindow, RaysAreKnownAsTheTrackerSaysAndTheSceneAllows) {
  Images corner;
  corner.add({1});
  EXPECT_LT((sigmas_px(corner) - Eigen::Vector2d(kCornerSigma_px, kCornerSigma_px)).norm(), 1e-3);
  Images aligned;
  aligned.show({1});
  aligned.features.information = {{100, 0, 25}};  // 0.1 px and 0.2 px
  aligned.window.add(1, aligned.features, aligned.order);
  const Eigen::Vector2d expected(std::hypot(0.1, kSceneSigma_px), std::hypot(0.2, kSceneSigma_px));
  EXPECT_LT((sigmas_px(aligned) - expected).norm(), 1e-3);
  Images not_aligned;
  not_aligned.show({1});
  not_aligned.features.information = {{}};
  not_aligned.window.add(1, not_aligned.features, not_aligned.order);
  EXPECT_LT((sigmas_px(not_aligned) - Eigen::Vector2d(kCornerSigma_px, kCornerSigma_px)).norm(),
            1e-3);
}

}  // namespace
}  // namespace ardrone_vslam
