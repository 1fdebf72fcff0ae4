// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels/align/align_kernels.hpp"

// The definition of an alignment, but for its sums. Included by one file for each instruction set,
// which gives a type of internal linkage, so that no code made for one processor can be taken for
// another's. It is made of a patch; its compare(pixels, stride_bytes, fraction_x, fraction_y) gives
// the AlignSums of the image, `pixels` being the one under the patch's first compared pixel, and
// the fractions what the patch lies further right and down [1 / kAlignSteps px].
namespace ardrone_vslam::kernels {

constexpr int kAlignSteps = 64;  ///< of a pixel, at which the image is sampled

/// Q15 factor of the row above; those of both rows make kRowsWeight. A level between four pixels is
/// (h0 w0 + h1 w1) / 2^15, each product rounded, h the rows' levels times kAlignSteps: 16 times the
/// level.
constexpr int kRowWeight = 128;

static inline std::int32_t nearestStep(float px) {
  const float steps = px * static_cast<float>(kAlignSteps);
  return static_cast<std::int32_t>(steps < 0 ? steps - 0.5F : steps + 0.5F);
}

/// What one comparison says.
struct AlignStep {
  float dx_px, dy_px;  // to go
  float gain, rest, contrast;
  bool is_good;
};

static inline AlignStep solveAlign(const AlignPatch& patch, const AlignSums& sums) {
  constexpr float kScale = 1.F / 16;
  const float* m = patch.inverse;
  const auto one = static_cast<float>(sums.one);
  const float d[3] = {static_cast<float>(sums.gradient_x) - one * patch.mean[0],
                      static_cast<float>(sums.gradient_y) - one * patch.mean[1],
                      static_cast<float>(sums.level) - one * patch.mean[2]};
  const float c[3] = {(m[0] * d[0] + m[1] * d[1]) + m[2] * d[2],
                      (m[1] * d[0] + m[3] * d[1]) + m[4] * d[2],
                      (m[2] * d[0] + m[4] * d[1]) + m[5] * d[2]};
  // Exact: 37 bits. As an integer it would need a library to become a float on a 32 bit processor.
  const auto all = static_cast<double>(sums.one);
  const double total = kPatchPixels * static_cast<double>(sums.square) - all * all;
  AlignStep step;
  step.contrast = static_cast<float>(total) * (kScale * kScale / kPatchPixels);
  step.rest = step.contrast - ((c[0] * d[0] + c[1] * d[1]) + c[2] * d[2]) * (kScale * kScale);
  step.gain = c[2] * kScale;
  // The image is gain * (level - gradient / 2 * shift) + offset.
  const float per_gain = -2 / c[2];
  step.dx_px = c[0] * per_gain;
  step.dy_px = c[1] * per_gain;
  // Of the exposure: what differs by more is something else.
  constexpr float kLeastGain = 0.4F;
  constexpr float kMostGain = 2.5F;
  step.is_good = step.gain > kLeastGain && step.gain < kMostGain;
  return step;
}

static inline float atMost(float value, float limit) {
  return value > limit ? limit : (value < -limit ? -limit : value);
}

template <class Comparison>
static inline AlignResult alignBy(const AlignPatch& patch, const std::uint8_t* pixels,
                                  std::ptrdiff_t stride_bytes, float x_px, float y_px) {
  constexpr int kMostSteps = 8;
  constexpr float kLongestStep_px = 1;  // gradients hold no further
  constexpr float kEnd_px = 0.03F;      // about the model's own error (patch_aligner.cpp)
  constexpr std::int32_t kFarthest = kAlignFarthest_px * kAlignSteps;
  constexpr int kFirst_px = kPatchSide / 2;
  const Comparison comparison(patch);
  const std::int32_t x_start = nearestStep(x_px);
  const std::int32_t y_start = nearestStep(y_px);
  std::int32_t x = x_start;
  std::int32_t y = y_start;
  AlignResult result;
  for (int i = 0; i < kMostSteps; ++i) {
    const std::uint8_t* first =
        pixels + (y / kAlignSteps - kFirst_px) * stride_bytes + (x / kAlignSteps - kFirst_px);
    const AlignStep step = solveAlign(
        patch, comparison.compare(first, stride_bytes, x % kAlignSteps, y % kAlignSteps));
    if (!step.is_good) return result;
    const float dx_px = atMost(step.dx_px, kLongestStep_px);
    const float dy_px = atMost(step.dy_px, kLongestStep_px);
    if (dx_px < kEnd_px && dx_px > -kEnd_px && dy_px < kEnd_px && dy_px > -kEnd_px) {
      constexpr float kStep_px = 1.F / kAlignSteps;
      return {static_cast<float>(x) * kStep_px + dx_px,
              static_cast<float>(y) * kStep_px + dy_px,
              step.gain,
              step.rest,
              step.contrast,
              true};
    }
    x += nearestStep(dx_px);
    y += nearestStep(dy_px);
    if (x - x_start > kFarthest || x_start - x > kFarthest || y - y_start > kFarthest ||
        y_start - y > kFarthest)
      return result;
  }
  return result;
}

}  // namespace ardrone_vslam::kernels
