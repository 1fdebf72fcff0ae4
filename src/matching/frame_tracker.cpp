// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/frame_tracker.hpp"

#include <cassert>
#include <limits>
#include <vector>

#include "matching/descriptor_matcher.hpp"
#include "matching/window_search.hpp"

namespace ardrone_vslam {

struct FrameTracker::State {
  FrameTrackerConfig config;
  MatcherConfig matcher;
  ImageFeatures previous;
  WindowSearch windows;             // among the previous features
  std::vector<BestTwo> of_present;  // best previous feature of each present one
  std::vector<int> carried_on;      // previous feature of each present one
  std::uint32_t next_id = 1;

  std::uint32_t takeId();
  void search(const ImageFeatures& features);
};

FrameTracker::FrameTracker(const FrameTrackerConfig& config, std::uint32_t first_track_id)
    : state_(std::make_unique<State>()) {
  assert(first_track_id != kNoTrack && "the first track id is the one that stands for no track");
  validate(config);
  state_->next_id = first_track_id;
  state_->config = config;
  state_->matcher.max_hamming_bits = config.max_hamming_bits;
  state_->matcher.ratio = config.ratio;
}

FrameTracker::~FrameTracker() = default;

void FrameTracker::reserve(std::size_t features, int width_px, int height_px) {
  state_->previous.reserve(features);
  state_->of_present.reserve(features);
  state_->carried_on.reserve(features);
  state_->windows.reserve(features, width_px, height_px);
}

std::uint32_t FrameTracker::nextTrackId() const {
  return state_->next_id;
}

std::uint32_t FrameTracker::State::takeId() {
  const std::uint32_t id = next_id++;
  if (next_id == kNoTrack) ++next_id;
  return id;
}

void FrameTracker::State::search(const ImageFeatures& features) {
  windows.build(previous.pixel_px, previous.descriptor);
  const auto radius_px = static_cast<float>(config.search_radius_px);
  of_present.resize(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    of_present[i] = windows.search(features.descriptor[i], features.pixel_px[i], radius_px,
                                   static_cast<int>(i));
  }
}

const std::vector<int>& FrameTracker::assign(ImageFeatures& features) {
  State& s = *state_;
  s.search(features);
  features.track_id.resize(features.size());
  features.age_frames.resize(features.size());
  s.carried_on.assign(features.size(), -1);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const BestTwo& best = s.of_present[i];
    const bool tracked =
        accept(best, s.matcher) && s.windows.nearestQuery(best.index) == static_cast<int>(i);
    if (tracked) {
      s.carried_on[i] = best.index;
      const auto j = static_cast<std::size_t>(best.index);
      constexpr auto kOldest = std::numeric_limits<std::uint16_t>::max();
      features.track_id[i] = s.previous.track_id[j];
      features.age_frames[i] = s.previous.age_frames[j] == kOldest
                                   ? kOldest
                                   : static_cast<std::uint16_t>(s.previous.age_frames[j] + 1);
    } else {
      features.track_id[i] = s.takeId();
      features.age_frames[i] = 0;
    }
  }
  s.previous = features;
  return s.carried_on;
}

}  // namespace ardrone_vslam
