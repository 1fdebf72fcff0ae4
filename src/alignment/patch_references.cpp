// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/patch_references.hpp"

#include <cmath>
#include <utility>

namespace ardrone_vslam {

void PatchReference::begin(const ImageView& image, const Eigen::Vector2f& point_px) {
  const auto x_px = static_cast<int>(std::lround(point_px.x()));
  const auto y_px = static_cast<int>(std::lround(point_px.y()));
  surroundings = surroundingsOf(image, x_px, y_px);
  patch.reset();
  is_to_be_made = true;
  offset_px = point_px - Eigen::Vector2i(x_px, y_px).cast<float>();
  change = applied = kSameView;
  is_new = true;
  failures = 0;
}

void PatchReference::adaptTo(const ViewChange& change_since) {
  constexpr float kAdaptAgain = 0.05F;  // 3 degrees, or 5 %
  constexpr float kMostGrowth = 1.6F;   // beyond it the surroundings have too little detail
  const float growth = std::sqrt(squareOf(change_since));
  const bool is_adapted = differenceOf(change_since, applied) >= kAdaptAgain &&
                          growth >= Surroundings::kLeastGrowth && growth <= kMostGrowth;
  if (!std::exchange(is_to_be_made, false) && !(patch && is_adapted)) return;
  const ViewChange wanted = is_adapted ? change_since : applied;
  const auto made = patchOf(surroundings, wanted);
  if (!made) return;
  patch = made;
  const ViewChange more = quotientOf(wanted, applied);
  offset_px = vectorOf(more * complexOf(offset_px));
  Eigen::Matrix2f rotation;
  rotation << more.real(), -more.imag(), more.imag(), more.real();
  variance_px2 = rotation * variance_px2 * rotation.transpose();
  applied = wanted;
}

void PatchReferences::reserve(std::size_t features) {
  references_.reserve(features);
  free_.reserve(features);
  before_.reserve(features);
  now_.reserve(features);
}

void PatchReferences::takeOver(const std::vector<int>& previous_of) {
  constexpr auto kTaken = static_cast<std::size_t>(-1);
  std::swap(before_, now_);
  now_.assign(previous_of.size(), kTaken);
  for (std::size_t i = 0; i < previous_of.size(); ++i)
    if (previous_of[i] >= 0)
      now_[i] = std::exchange(before_[static_cast<std::size_t>(previous_of[i])], kTaken);
  for (const std::size_t place : before_)
    if (place != kTaken) free_.push_back(place);
  for (std::size_t& place : now_) {
    if (place != kTaken) continue;
    if (free_.empty()) {
      free_.push_back(references_.size());
      references_.emplace_back();
    }
    place = free_.back();
    free_.pop_back();
    references_[place].variance_px2.setZero();
  }
}

}  // namespace ardrone_vslam
