// SPDX-License-Identifier: BSD-3-Clause
#include "world_sequence.hpp"

#include <cmath>
#include <stdexcept>

#include "random_source.hpp"
#include "range_readings.hpp"
#include "world_room.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kFirstStamp_ns = 1000000000;
constexpr double kMostImages = 1e7;

std::size_t imageCount(const WorldOptions& options) {
  const double count = std::round(options.duration_s * options.rate_hz);
  if (!(options.rate_hz > 0) || !(count >= 1) || !(count <= kMostImages)) {
    throw std::invalid_argument(
        "seconds times rate must give at least one image and at most ten million");
  }
  return static_cast<std::size_t>(count);
}

Trajectory flyTruth(const WorldOptions& options) {
  const auto flight = makeFlight(options.flight, options.start);
  const Eigen::Isometry3d T_body_base = arDroneFrontMount() * options.T_base_cam.inverse();
  const std::size_t count = imageCount(options);
  Trajectory truth;
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) / options.rate_hz;
    truth.append({kFirstStamp_ns + std::llround(t_s * 1e9), flight->pose(t_s) * T_body_base});
  }
  return truth;
}

}  // namespace

CameraIntrinsics arDroneFrontCamera() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 360;
  camera.fx_px = 570;
  camera.fy_px = 570;
  camera.cx_px = 320;
  camera.cy_px = 180;
  camera.k1 = -0.525;
  camera.k2 = 0.274;
  return camera;
}

Eigen::Isometry3d arDroneFrontMount() {
  return Eigen::Translation3d(0.21, 0, 0) * forwardCamera();
}

WorldSequence::WorldSequence(const WorldOptions& options)
    : options_(options),
      renderer_(options.camera, options.image_noise_grey),
      truth_(flyTruth(options)) {
  room_ = makeRoom(options.world_seed);
  if (options.observer) observer_ = simulateObserver(truth_, *options.observer, options.seed);
  if (options.range_noise_m) ranges_ = simulateRanges(truth_, *options.range_noise_m, options.seed);
}

cv::Mat WorldSequence::image(std::size_t index) {
  const Eigen::Isometry3d T_world_cam = truth_.poses().at(index).T_map_base * options_.T_base_cam;
  return renderer_.render(room_, T_world_cam,
                          RandomSource::mix(options_.seed) + static_cast<std::uint64_t>(index));
}

}  // namespace ardrone_vslam
