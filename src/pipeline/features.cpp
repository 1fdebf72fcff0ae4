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

std::size_t ImageFeatures::tracked() const {
  return static_cast<std::size_t>(std::count_if(age_frames.begin(), age_frames.end(),
                                                [](std::uint16_t age) { return age > 0; }));
}

std::size_t ImageFeatures::aligned() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < information.size(); ++i)
    if (age_frames[i] > 0 && !information[i].empty()) ++count;
  return count;
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
