// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/patch_aligner.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "alignment/patch.hpp"

namespace ardrone_vslam {
namespace {

// A patch that explains less of the image is another one, or is hidden.
constexpr float kLeastExplained = 0.7F;
// The view has changed: the next images are compared with this one.
constexpr float kRenewBelow = 0.9F;
// A track is seldom hidden for longer: after so many images its corner counts.
constexpr int kMostFailures = 2;
// Of a corner on a whole pixel, each way.
constexpr float kCornerVariance_px2 = 0.4F;
// What the grey levels' noise does not tell: sampling, and that the view changes.
constexpr float kModelFactor2 = 1.4F * 1.4F;
constexpr float kModelVariance_px2 = 0.025F * 0.025F;

/// The track is where its corner is, whatever was known of it before.
void beginAtCorner(const ImageView& image, const Eigen::Vector2f& corner_px,
                   PatchReference& reference) {
  reference.begin(image, corner_px);
  reference.variance_px2 = kCornerVariance_px2 * Eigen::Matrix2f::Identity();
}

/// In the direction that is known best.
float leastVariance(const Eigen::Matrix2f& variance) {
  return variance.trace() / 2 -
         Eigen::Vector2f((variance(0, 0) - variance(1, 1)) / 2, variance(0, 1)).norm();
}

}  // namespace

void PatchAligner::reserve(std::size_t features) {
  references_.reserve(features);
  before_px_.reserve(features);
  moves_.reserve(features);
}

void PatchAligner::align(const ImageView& image, const std::vector<int>& previous_of,
                         ImageFeatures& features) {
  features.information.assign(features.size(), {});
  features.residual.assign(features.size(), 0);
  references_.takeOver(previous_of);
  for (std::size_t i = 0; i < features.size(); ++i) {
    PatchReference& reference = references_[i];
    if (previous_of[i] >= 0) {
      reference.adaptTo(change_ * reference.change);  // the view goes on as it did
      goOn(image, i, features);
      continue;
    }
    // The corner is the track's point, so that it is where it is by definition.
    reference.begin(image, features.pixel_px[i]);
    features.information[i] = {1 / kModelVariance_px2, 0, 1 / kModelVariance_px2};
  }
  measureChange(previous_of, features);
  before_px_.assign(features.pixel_px.begin(), features.pixel_px.end());
}

void PatchAligner::measureChange(const std::vector<int>& previous_of,
                                 const ImageFeatures& features) {
  moves_.clear();
  for (std::size_t i = 0; i < previous_of.size(); ++i) {
    if (previous_of[i] < 0) continue;
    moves_.push_back({complexOf(before_px_[static_cast<std::size_t>(previous_of[i])]),
                      complexOf(features.pixel_px[i])});
  }
  change_ = commonViewChange(moves_);
  for (std::size_t i = 0; i < features.size(); ++i) {
    PatchReference& reference = references_[i];
    if (!std::exchange(reference.is_new, false)) reference.change = change_ * reference.change;
  }
}

void PatchAligner::goOn(const ImageView& image, std::size_t feature, ImageFeatures& features) {
  PatchReference& reference = references_[feature];
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
    beginAtCorner(image, corner_px, reference);
    return;
  }
  reference.failures = 0;
  Eigen::Matrix2f variance_px2 = kModelFactor2 * positionVariance_px2(*reference.patch, found);
  variance_px2 += reference.variance_px2;
  variance_px2.diagonal().array() += kModelVariance_px2;
  const Eigen::Matrix2f information = variance_px2.inverse();
  features.pixel_px[feature] = point_px;
  features.bearing_cam[feature] = bearing->cast<float>();
  features.information[feature] = {information(0, 0), information(0, 1), information(1, 1)};
  features.residual[feature] = std::sqrt(std::max(found.rest, 0.F) / kernels::kPatchPixels);
  if (explainedShare(found) >= kRenewBelow) return;
  if (leastVariance(variance_px2) > kCornerVariance_px2) {
    beginAtCorner(image, corner_px, reference);  // the chain of views has lost more
    return;
  }
  reference.begin(image, point_px);
  reference.variance_px2 = variance_px2;
}

}  // namespace ardrone_vslam
