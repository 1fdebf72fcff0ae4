// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/features.hpp"

#include <algorithm>

namespace ardrone_vslam {

void ImageFeatures::clear() {
  pixel_px.clear();
  bearing_cam.clear();
  score.clear();
  track_id.clear();
  age_frames.clear();
  descriptor.clear();
  information.clear();
  residual.clear();
}

std::size_t ImageFeatures::aligned() const {
  const auto none = std::count_if(information.begin(), information.end(),
                                  [](const PixelInformation& known) { return known.empty(); });
  return information.size() - static_cast<std::size_t>(none);
}

void ImageFeatures::reserve(std::size_t count) {
  pixel_px.reserve(count);
  bearing_cam.reserve(count);
  score.reserve(count);
  track_id.reserve(count);
  age_frames.reserve(count);
  descriptor.reserve(count);
  information.reserve(count);
  residual.reserve(count);
}

}  // namespace ardrone_vslam
