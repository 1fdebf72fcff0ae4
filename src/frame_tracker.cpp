// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/frame_tracker.hpp"

#include <limits>
#include <vector>

#include "ardrone_vslam/descriptor_matcher.hpp"
#include "ardrone_vslam/pixel_grid.hpp"

namespace ardrone_vslam {

struct FrameTracker::State {
  FrameTrackerConfig config;
  MatcherConfig matcher;
  ImageFeatures previous;
  PixelGrid grid;                    // of the previous frame
  std::vector<BestTwo> of_present;   // best previous feature of each present one
  std::vector<BestTwo> of_previous;  // and the other way round
  std::uint32_t next_id = 1;

  void search(const ImageFeatures& features);
};

FrameTracker::FrameTracker(const FrameTrackerConfig& config) : state_(std::make_unique<State>()) {
  validate(config);
  state_->config = config;
  state_->matcher.max_hamming_bits = config.max_hamming_bits;
  state_->matcher.ratio = config.ratio;
}

FrameTracker::~FrameTracker() = default;

void FrameTracker::State::search(const ImageFeatures& features) {
  grid.build(previous.pixel_px, previous.width_px, previous.height_px);
  of_present.assign(features.size(), BestTwo{});
  of_previous.assign(previous.size(), BestTwo{});
  const auto radius = static_cast<float>(config.search_radius_px);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Eigen::Vector2f& pixel = features.pixel_px[i];
    grid.visit(pixel, radius, [&](int candidate) {
      const auto j = static_cast<std::size_t>(candidate);
      if ((previous.pixel_px[j] - pixel).squaredNorm() > radius * radius) return;
      const int distance = hammingDistance(features.descriptor[i], previous.descriptor[j]);
      of_present[i].offer(candidate, distance);
      of_previous[j].offer(static_cast<int>(i), distance);
    });
  }
}

void FrameTracker::assign(ImageFeatures& features) {
  State& s = *state_;
  s.search(features);
  features.track_id.resize(features.size());
  features.age_frames.resize(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const BestTwo& best = s.of_present[i];
    const bool tracked =
        accept(best, s.matcher) &&
        s.of_previous[static_cast<std::size_t>(best.index)].index == static_cast<int>(i);
    if (tracked) {
      const auto j = static_cast<std::size_t>(best.index);
      constexpr auto kOldest = std::numeric_limits<std::uint16_t>::max();
      features.track_id[i] = s.previous.track_id[j];
      features.age_frames[i] = s.previous.age_frames[j] == kOldest
                                   ? kOldest
                                   : static_cast<std::uint16_t>(s.previous.age_frames[j] + 1);
    } else {
      features.track_id[i] = s.next_id++;
      features.age_frames[i] = 0;
    }
  }
  s.previous = features;
}

}  // namespace ardrone_vslam
