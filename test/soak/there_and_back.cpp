// SPDX-License-Identifier: BSD-3-Clause
#include "soak/there_and_back.hpp"

#include <algorithm>
#include <cmath>

#include "sequences/drone_cameras.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr double kNoise_grey = 2;
constexpr std::size_t kNoiseOffsets = 1 << 20;

/// The drone's front camera, of 320x240 pixels.
CameraIntrinsics smallCamera() {
  CameraIntrinsics camera = cameraNamed("front_wide").intrinsics;
  camera.width_px = 320;
  camera.height_px = 240;
  camera.fx_px = camera.fy_px = 285;
  camera.cx_px = 160;
  camera.cy_px = 120;
  return camera;
}

}  // namespace

ThereAndBack::ThereAndBack(double way_s, std::uint64_t seed)
    : camera_(smallCamera()), T_base_cam_(arDroneFrontMount()), random_(seed) {
  WorldOptions options;
  options.flight = way_s == kLap_s ? "laps_then_hover" : "laps";
  options.camera = camera_;
  options.effects.noise_grey = 0;
  // One image more: both ends of the way are in it.
  options.duration_s = way_s + 1.0 / kImages_hz;
  WorldSequence way(options);
  for (std::size_t i = 0; i < way.size(); ++i) {
    images_.push_back(way.image(i));
    T_map_base_of_images_.push_back(way.truth().poses()[i].T_frame_body);
  }
  // Base is the middle of the drone.
  for (int i = 0; i <= std::lround(way_s * kPoses_hz); ++i)
    T_map_base_.push_back(way.flight().pose(static_cast<double>(i) / kPoses_hz));
  noise_.resize(images_.front().total() + kNoiseOffsets);
  for (std::int8_t& value : noise_)
    value = static_cast<std::int8_t>(std::lround(kNoise_grey * random_.normal()));
  noisy_.create(images_.front().size(), CV_8UC1);
}

ImageView ThereAndBack::image(std::uint64_t index) {
  const cv::Mat& clean = at(images_, index);
  const std::int8_t* noise = noise_.data() + random_.integer(0, kNoiseOffsets - 1);
  for (std::size_t i = 0; i < clean.total(); ++i)
    noisy_.data[i] = static_cast<std::uint8_t>(std::clamp(clean.data[i] + noise[i], 0, 255));
  return {noisy_.data, noisy_.cols, noisy_.rows, static_cast<std::ptrdiff_t>(noisy_.step)};
}

}  // namespace ardrone_vslam::test
