// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/patch_aligner.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ardrone_vslam {
namespace {

// A patch that explains less of the image is another one, or is hidden.
constexpr float kLeastExplained = 0.7F;
// The view has changed: the next images are compared with this one.
constexpr float kRenewBelow = 0.9F;
// The patch is made anew where the view has turned or grown so much more: 3 degrees, or 5 %. Beyond
// kMostGrowth the surroundings have too little detail.
constexpr float kTurnAgain = 0.05F;
constexpr float kMostGrowth = 1.6F;
// A track is seldom hidden for longer: after so many images its corner counts.
constexpr int kMostFailures = 2;
// Of a corner on a whole pixel, each way.
constexpr float kCornerVariance_px2 = 0.4F;
// What the grey levels' noise does not tell: sampling, and that the view changes.
constexpr float kModelFactor2 = 1.4F * 1.4F;
constexpr float kModelVariance_px2 = 0.025F * 0.025F;
constexpr float kPixels = kernels::kPatchSide * kernels::kPatchSide;

Eigen::Vector2i nearestPixel(const Eigen::Vector2f& pixel_px) {
  return {static_cast<int>(std::lround(pixel_px.x())), static_cast<int>(std::lround(pixel_px.y()))};
}

}  // namespace

void PatchAligner::reserve(std::size_t features) {
  references_.reserve(features);
  free_.reserve(features);
  before_.reserve(features);
  now_.reserve(features);
  before_px_.reserve(features);
  moves_.reserve(features);
}

void PatchAligner::align(const ImageView& image, const std::vector<int>& previous_of,
                         ImageFeatures& features) {
  features.information.assign(features.size(), {});
  features.residual.assign(features.size(), 0);
  takeOver(previous_of);
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (previous_of[i] >= 0) {
      Reference& reference = references_[now_[i]];
      turnTo(change_ * reference.change, reference);  // it goes on as it was
      goOn(image, i, reference, features);
      continue;
    }
    now_[i] = freeReference();
    Reference& reference = references_[now_[i]];
    // The corner is the track's point, so that it is where it is by definition.
    reference.variance_px2 = 0;
    begin(image, features.pixel_px[i], reference);
    if (reference.patch)
      features.information[i] = {1 / kModelVariance_px2, 0, 1 / kModelVariance_px2};
  }
  measureChange(previous_of, features);
  before_px_.assign(features.pixel_px.begin(), features.pixel_px.end());
  std::swap(before_, now_);
}

void PatchAligner::takeOver(const std::vector<int>& previous_of) {
  constexpr auto kTaken = static_cast<std::size_t>(-1);
  now_.assign(previous_of.size(), kTaken);
  for (std::size_t i = 0; i < previous_of.size(); ++i) {
    if (previous_of[i] < 0) continue;
    now_[i] = std::exchange(before_[static_cast<std::size_t>(previous_of[i])], kTaken);
  }
  for (const std::size_t place : before_)
    if (place != kTaken) free_.push_back(place);
}

std::size_t PatchAligner::freeReference() {
  if (free_.empty()) {
    references_.emplace_back();
    return references_.size() - 1;
  }
  const std::size_t place = free_.back();
  free_.pop_back();
  return place;
}

void PatchAligner::measureChange(const std::vector<int>& previous_of,
                                 const ImageFeatures& features) {
  moves_.clear();
  for (std::size_t i = 0; i < previous_of.size(); ++i) {
    if (previous_of[i] < 0) continue;
    moves_.push_back({before_px_[static_cast<std::size_t>(previous_of[i])], features.pixel_px[i]});
  }
  change_ = commonViewChange(moves_);
  for (const std::size_t place : now_) {
    Reference& reference = references_[place];
    if (!std::exchange(reference.is_new, false)) reference.change = change_ * reference.change;
  }
}

void PatchAligner::turnTo(const ViewChange& change, Reference& reference) {
  const float growth = change.growth();
  if (!reference.patch || change.differenceFrom(reference.applied) < kTurnAgain ||
      growth < Surroundings::kLeastGrowth || growth > kMostGrowth)
    return;
  const auto turned = patchOf(reference.surroundings, change);
  if (!turned) return;
  reference.patch = turned;
  reference.offset_px = change * (reference.applied.inverse() * reference.offset_px);
  reference.applied = change;
}

void PatchAligner::begin(const ImageView& image, const Eigen::Vector2f& point_px,
                         Reference& reference) const {
  const Eigen::Vector2i pixel = nearestPixel(point_px);
  reference.surroundings = surroundingsOf(image, pixel.x(), pixel.y());
  reference.patch = patchOf(reference.surroundings);
  reference.offset_px = point_px - pixel.cast<float>();
  reference.change = {};
  reference.applied = {};
  reference.is_new = true;
  reference.failures = 0;
}

void PatchAligner::goOn(const ImageView& image, std::size_t feature, Reference& reference,
                        ImageFeatures& features) const {
  const Eigen::Vector2f corner_px = features.pixel_px[feature];
  const Eigen::Vector2f start_px = corner_px - reference.offset_px;
  kernels::AlignResult found;
  if (reference.patch)
    found = align_(*reference.patch, image.data, image.stride_bytes, start_px.x(), start_px.y());
  const bool fits = found.is_found && explainedShare(found) > kLeastExplained;
  const Eigen::Vector2f point_px = Eigen::Vector2f(found.x_px, found.y_px) + reference.offset_px;
  const auto bearing = fits ? camera_.bearing(point_px.cast<double>()) : std::nullopt;
  if (!bearing) {
    if (++reference.failures < kMostFailures) return;
    reference.variance_px2 += kCornerVariance_px2;
    begin(image, corner_px, reference);
    return;
  }
  reference.failures = 0;
  Eigen::Matrix2f variance_px2 = kModelFactor2 * positionVariance_px2(*reference.patch, found);
  variance_px2.diagonal().array() += reference.variance_px2 + kModelVariance_px2;
  const Eigen::Matrix2f information = variance_px2.inverse();
  features.pixel_px[feature] = point_px;
  features.bearing_cam[feature] = bearing->cast<float>();
  features.information[feature] = {information(0, 0), information(0, 1), information(1, 1)};
  features.residual[feature] = std::sqrt(std::max(found.rest, 0.F) / kPixels);
  if (explainedShare(found) >= kRenewBelow) return;
  reference.variance_px2 = variance_px2.trace() / 2;
  begin(image, point_px, reference);
}

}  // namespace ardrone_vslam
