// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/freak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "freak_pattern.hpp"
#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

using kernels::kFreakFields;
using Means = std::array<std::uint8_t, kernels::kFreakPaddedFields>;

/// Integral image whose buffer is kept from frame to frame. 16 bits are exact for the pattern's own
/// scale and half the memory traffic; enlarged patterns need 32.
template <class Sum>
struct Integral {
  std::vector<Sum> sums;
  std::ptrdiff_t stride = 0;

  Sum* resize(const ImageView& image) {
    stride = image.width_px + 1;
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

/// @return the orientation in degrees, as FREAK rounds it to float.
float angleOf_deg(const std::array<std::int32_t, 2>& sums) {
  constexpr double kPi = 3.14159265358979323846;
  const double y = sums[1];
  const double x = sums[0];
  return static_cast<float>(std::atan2(y, x) * (180.0 / kPi));
}

int orientationOf(float angle_deg) {
  const double index = kFreakOrientations * static_cast<double>(angle_deg) / 360.0;  // -128..128
  return static_cast<int>(std::lrint(index)) & (kFreakOrientations - 1);
}

}  // namespace

struct FreakDescriber::State {
  explicit State(const FreakConfig& freak_config) : config(freak_config) {}

  void select(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
              std::vector<int>& kept);
  void computeIntegrals(const ImageView& image);
  void computeMeans(const FreakKeypoint& keypoint, int scale, int orientation, Means& means) const;
  Descriptor describeOne(const FreakKeypoint& keypoint, int scale, float& angle_deg) const;

  FreakConfig config;
  FreakPattern pattern;
  Integral<std::uint16_t> integral16;
  Integral<std::uint32_t> integral32;
  std::vector<int> scales;  ///< of the kept keypoints
  bool boxes_hold = true;   ///< the image is small enough for the pattern's table of boxes
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
    kernels::kernelsInUse().freak_integral16(pixels, sums, integral16.stride);
  }
  if (std::any_of(scales.begin(), scales.end(), isEnlarged)) {
    std::uint32_t* sums = integral32.resize(image);
    kernels::kernelsInUse().freak_integral32(pixels, sums, integral32.stride);
  }
  boxes_hold = std::max(image.width_px, image.height_px) <= FreakPattern::kLargestSide_px;
}

void FreakDescriber::State::computeMeans(const FreakKeypoint& keypoint, int scale, int orientation,
                                         Means& means) const {
  const int x = keypoint.x_px;
  const int y = keypoint.y_px;
  if (scale == 0 && boxes_hold) {
    kernels::kernelsInUse().freak_means(integral16.at(x, y), integral16.stride,
                                        pattern.boxes(orientation), means.data());
    for (const auto& irregular : pattern.irregular(orientation)) {
      means[static_cast<std::size_t>(irregular.index)] =
          integral16.mean(boxAround(irregular.field, x, y));
    }
    return;
  }
  for (int index = 0; index < kFreakFields; ++index) {
    const FreakPixelBox box = boxAround(pattern.field(scale, orientation, index), x, y);
    means[static_cast<std::size_t>(index)] =
        scale == 0 ? integral16.mean(box) : integral32.mean(box);
  }
}

Descriptor FreakDescriber::State::describeOne(const FreakKeypoint& keypoint, int scale,
                                              float& angle_deg) const {
  Means means;
  computeMeans(keypoint, scale, 0, means);
  angle_deg = 0.F;
  if (config.oriented) {
    std::array<std::int32_t, 2> sums;
    kernels::kernelsInUse().freak_orientation(means.data(), pattern.orientationPairs(),
                                              sums.data());
    angle_deg = angleOf_deg(sums);
    const int orientation = orientationOf(angle_deg);
    if (orientation != 0) computeMeans(keypoint, scale, orientation, means);
  }
  Descriptor descriptor;
  kernels::kernelsInUse().freak_bits(means.data(), pattern.first(), pattern.second(),
                                     descriptor.words.data());
  return descriptor;
}

FreakDescriber::FreakDescriber(const FreakConfig& config)
    : state_(std::make_unique<State>(config)) {}
FreakDescriber::~FreakDescriber() = default;

void FreakDescriber::describe(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
                              std::vector<int>& kept, std::vector<Descriptor>& descriptors,
                              std::vector<float>* angles_deg) {
  state_->select(image, keypoints, kept);
  descriptors.resize(kept.size());
  if (angles_deg != nullptr) angles_deg->resize(kept.size());
  if (kept.empty()) return;
  state_->computeIntegrals(image);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    float angle_deg = 0.F;
    const FreakKeypoint& keypoint = keypoints[static_cast<std::size_t>(kept[k])];
    descriptors[k] = state_->describeOne(keypoint, state_->scales[k], angle_deg);
    if (angles_deg != nullptr) (*angles_deg)[k] = angle_deg;
  }
}

}  // namespace ardrone_vslam
