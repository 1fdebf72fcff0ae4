// SPDX-License-Identifier: BSD-3-Clause
#include "freak/freak.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "freak/freak_orientation.hpp"
#include "freak/freak_pattern.hpp"
#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

using kernels::kFreakFields;
constexpr int kUnknown = -1;
/// Keypoints described together, step by step: each step's results are waited for while the other
/// keypoints' are computed. The pixels of four stay in the first-level cache.
constexpr std::size_t kBlock = 4;
using Means = std::array<std::uint8_t, kernels::kFreakPaddedFields>;

/// A keypoint on its way to a descriptor, in a cache line: means across two are slow to read back.
struct alignas(64) Patch {
  int x_px, y_px, scale;
  int orientation;
  Means means;
};

/// Integral image whose buffer is kept from frame to frame. 16 bits are exact for the pattern's own
/// scale and half the memory traffic; enlarged patterns need 32.
template <class Sum>
struct Integral {
  std::vector<Sum> sums;
  std::ptrdiff_t stride = 0;

  Sum* resize(const ImageView& image) {
    stride = kernels::freakIntegralStride(image.width_px);
    sums.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(image.height_px + 1));
    return sums.data();
  }
  const Sum* at(int x_px, int y_px) const { return sums.data() + y_px * stride + x_px; }

  std::uint8_t mean(const FreakPixelBox& box) const {
    const auto sum =
        static_cast<Sum>(*at(box.right_px, box.bottom_px) - *at(box.left_px, box.bottom_px) -
                         *at(box.right_px, box.top_px) + *at(box.left_px, box.top_px));
    const auto area =
        static_cast<std::uint32_t>((box.right_px - box.left_px) * (box.bottom_px - box.top_px));
    return static_cast<std::uint8_t>((sum + area / 2) / area);
  }
};

}  // namespace

struct FreakDescriber::State {
  State(const FreakConfig& freak_config, InstructionSet set)
      : config(freak_config), kernels(kernels::kernelsFor(set)) {}

  void select(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
              std::vector<int>& kept);
  void computeIntegrals(const ImageView& image);
  void computeMeans(Patch& patch) const;
  int orientationOf(const Means& means, float* angle_deg) const;
  void describeBlock(Patch* patches, std::size_t count, Descriptor* descriptors,
                     float* angles_deg) const;

  FreakConfig config;
  kernels::Kernels kernels;
  FreakPattern pattern;
  Integral<std::uint16_t> integral16;
  Integral<std::uint32_t> integral32;
  int known_orientation = kUnknown;  ///< of all keypoints
  std::vector<int> scales;           ///< of the kept keypoints
  bool boxes_hold = true;            ///< the image is small enough for the pattern's table of boxes
};

void FreakDescriber::State::select(const ImageView& image,
                                   const std::vector<FreakKeypoint>& keypoints,
                                   std::vector<int>& kept) {
  kept.clear();
  scales.clear();
  if (image.empty()) return;
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    const FreakKeypoint& keypoint = keypoints[k];
    const int scale = FreakPattern::scaleOf(keypoint.size_px);
    const int border = pattern.border_px(scale);
    if (keypoint.x_px <= border || keypoint.x_px >= image.width_px - border) continue;
    if (keypoint.y_px <= border || keypoint.y_px >= image.height_px - border) continue;
    kept.push_back(static_cast<int>(k));
    scales.push_back(scale);
  }
}

void FreakDescriber::State::computeIntegrals(const ImageView& image) {
  const kernels::FreakImage pixels{image.data, image.stride_bytes, image.width_px, image.height_px};
  const auto isEnlarged = [](int scale) { return scale > 0; };
  if (!std::all_of(scales.begin(), scales.end(), isEnlarged)) {
    std::uint16_t* sums = integral16.resize(image);
    kernels.freak_integral16(pixels, sums, integral16.stride);
  }
  if (std::any_of(scales.begin(), scales.end(), isEnlarged)) {
    std::uint32_t* sums = integral32.resize(image);
    kernels.freak_integral32(pixels, sums, integral32.stride);
  }
  boxes_hold = std::max(image.width_px, image.height_px) <= FreakPattern::kLargestSide_px;
}

void FreakDescriber::State::computeMeans(Patch& patch) const {
  const int x = patch.x_px;
  const int y = patch.y_px;
  if (patch.scale == 0 && boxes_hold) {
    kernels.freak_means(integral16.at(x, y), integral16.stride,
                        pattern.boxes(patch.orientation, x, y), patch.means.data());
    if (!pattern.isExceptional(x, y)) return;
    for (const auto& irregular : pattern.irregular(patch.orientation)) {
      patch.means[static_cast<std::size_t>(irregular.index)] =
          integral16.mean(boxAround(irregular.field, x, y));
    }
    return;
  }
  for (int index = 0; index < kFreakFields; ++index) {
    const FreakPixelBox box = boxAround(pattern.field(patch.scale, patch.orientation, index), x, y);
    patch.means[static_cast<std::size_t>(index)] =
        patch.scale == 0 ? integral16.mean(box) : integral32.mean(box);
  }
}

int FreakDescriber::State::orientationOf(const Means& means, float* angle_deg) const {
  std::array<std::int32_t, 2> sums;
  kernels.freak_orientation(means.data(), pattern.orientationPairs(), sums.data());
  if (angle_deg == nullptr) return freakOrientation(sums[0], sums[1]);
  *angle_deg = freakAngle_deg(sums[0], sums[1]);
  return freakOrientation(*angle_deg);
}

void FreakDescriber::State::describeBlock(Patch* patches, std::size_t count,
                                          Descriptor* descriptors, float* angles_deg) const {
  for (std::size_t k = 0; k < count; ++k) computeMeans(patches[k]);
  if (config.oriented && known_orientation == kUnknown) {
    for (std::size_t k = 0; k < count; ++k) {
      patches[k].orientation =
          orientationOf(patches[k].means, angles_deg == nullptr ? nullptr : angles_deg + k);
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (patches[k].orientation != 0) computeMeans(patches[k]);
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    kernels.freak_bits(patches[k].means.data(), pattern.comparisons(), descriptors[k].words.data());
  }
}

FreakDescriber::FreakDescriber(const FreakConfig& config, InstructionSet set)
    : state_(std::make_unique<State>(config, set)) {}
FreakDescriber::~FreakDescriber() = default;

void FreakDescriber::describe(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
                              std::vector<int>& kept, std::vector<Descriptor>& descriptors,
                              std::vector<float>* angles_deg,
                              std::optional<float> orientation_rad) {
  state_->select(image, keypoints, kept);
  descriptors.resize(kept.size());
  const float known_deg = orientation_rad ? degreesWithinHalfTurn(*orientation_rad) : 0.F;
  state_->known_orientation = orientation_rad ? freakOrientation(known_deg) : kUnknown;
  if (angles_deg != nullptr) angles_deg->assign(kept.size(), known_deg);
  if (kept.empty()) return;
  state_->computeIntegrals(image);
  std::array<Patch, kBlock> patches{};
  for (std::size_t first = 0; first < kept.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, kept.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      const FreakKeypoint& keypoint = keypoints[static_cast<std::size_t>(kept[first + k])];
      patches[k].x_px = keypoint.x_px;
      patches[k].y_px = keypoint.y_px;
      patches[k].scale = state_->scales[first + k];
      patches[k].orientation = std::max(state_->known_orientation, 0);
    }
    state_->describeBlock(patches.data(), count, descriptors.data() + first,
                          angles_deg == nullptr ? nullptr : angles_deg->data() + first);
  }
}

}  // namespace ardrone_vslam
