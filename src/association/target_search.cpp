// SPDX-License-Identifier: BSD-3-Clause
#include "association/target_search.hpp"

namespace ardrone_vslam {

void TargetSearch::begin(const FrameView& view, std::size_t target_count) {
  best_of_target_.assign(target_count, BestTwo{});
  taken_.assign(view.size(), false);
  tracks_.reset(view.features());
}

int TargetSearch::featureOfTrack(std::uint32_t track_id) const {
  // Most landmarks of a large map were seen last before the oldest of the frame's tracks began.
  if (tracks_.begin() == tracks_.end() || track_id < tracks_.begin()->track_id) return kNobody;
  const TrackedFeature* entry = tracks_.find(track_id);
  return entry == nullptr ? kNobody : static_cast<int>(entry->feature);
}

void TargetSearch::openWindows(const FrameView& view) {
  windows_.build(view.idealPixels(), view.features().descriptor, taken_);
}

void TargetSearch::search(int target, const DescriptorBits& descriptor,
                          const Eigen::Vector2f& centre_px, float radius_px) {
  best_of_target_[static_cast<std::size_t>(target)] =
      windows_.search(descriptor, centre_px, radius_px, target);
}

int TargetSearch::bestFeature(int target) const {
  const BestTwo& best = best_of_target_[static_cast<std::size_t>(target)];
  if (!accept(best, config_)) return kNobody;
  if (isTaken(best.index)) return kNobody;  // by a target before, if there is no cross check
  if (config_.cross_check && windows_.nearestQuery(best.index) != target) return kNobody;
  return best.index;
}

}  // namespace ardrone_vslam
