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
constexpr float kModelFactor2 = 1.8F * 1.8F;
constexpr float kModelVariance_px2 = 0.05F * 0.05F;
constexpr float kPixels = kernels::kPatchSide * kernels::kPatchSide;

Eigen::Vector2i nearestPixel(const Eigen::Vector2f& pixel_px) {
  return {static_cast<int>(std::lround(pixel_px.x())), static_cast<int>(std::lround(pixel_px.y()))};
}

}  // namespace

void PatchAligner::reserve(std::size_t features) {
  references_.reserve(features);
  next_.reserve(features);
}

void PatchAligner::align(const ImageView& image, const std::vector<int>& previous_of,
                         ImageFeatures& features) {
  features.information.assign(features.size(), {});
  features.residual.assign(features.size(), 0);
  next_.clear();
  for (std::size_t i = 0; i < features.size(); ++i) {
    const int previous = previous_of[i];
    Reference& reference = next_.emplace_back(
        previous < 0 ? Reference{} : references_[static_cast<std::size_t>(previous)]);
    if (previous >= 0) {
      goOn(image, i, reference, features);
      continue;
    }
    // The corner is the track's point, so that it is where it is by definition.
    begin(image, features.pixel_px[i], reference);
    if (reference.patch)
      features.information[i] = {1 / kModelVariance_px2, 0, 1 / kModelVariance_px2};
  }
  std::swap(references_, next_);
}

void PatchAligner::begin(const ImageView& image, const Eigen::Vector2f& point_px,
                         Reference& reference) const {
  const Eigen::Vector2i pixel = nearestPixel(point_px);
  reference.patch = patchOf(image, pixel.x(), pixel.y());
  reference.offset_px = point_px - pixel.cast<float>();
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
