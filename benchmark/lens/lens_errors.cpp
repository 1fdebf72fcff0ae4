// SPDX-License-Identifier: BSD-3-Clause
#include "lens_errors.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/random_source.hpp"
#include "thread_time.hpp"
#include "trajectory/metrics.hpp"

namespace ardrone_vslam::bench {
namespace {

Pixels wholeImage(const CameraIntrinsics& c) {
  Pixels pixels;
  for (int y = 0; y < c.height_px; ++y)
    for (int x = 0; x < c.width_px; ++x) pixels.emplace_back(x, y);
  return pixels;
}

Eigen::Vector2d onPlane_px(const CameraIntrinsics& c, const Eigen::Vector3d& direction) {
  return Eigen::Vector2d(c.fx_px * direction.x(), c.fy_px * direction.y()) / direction.z();
}

}  // namespace

std::vector<double> errors_px(const CameraIntrinsics& c, const LensMethod& method) {
  const Pixels pixels = wholeImage(c);
  const CameraModel exact(c, UndistortMethod::kExact);
  Directions found(pixels.size());
  method.correct(pixels, found);
  std::vector<double> errors;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto truth = exact.bearing(pixels[i]);
    errors.push_back(truth ? (onPlane_px(c, found[i]) - onPlane_px(c, *truth)).norm() : NAN);
  }
  return errors;
}

LensErrors summaryOf(const std::vector<double>& errors) {
  LensErrors e;
  for (const double error : errors) {
    if (std::isnan(error)) {
      ++e.refused;
      continue;
    }
    e.mean_px += error;
    e.largest_px = std::max(e.largest_px, error);
  }
  e.mean_px /= static_cast<double>(errors.size()) - e.refused;
  return e;
}

std::vector<double> times_ns(const CameraIntrinsics& c, const std::vector<LensMethod>& methods,
                             int rounds) {
  RandomSource random(1);
  Pixels pixels;
  while (pixels.size() < kTimedPixels)
    pixels.emplace_back(random.uniform(0, c.width_px - 1), random.uniform(0, c.height_px - 1));
  Directions found(pixels.size());
  std::vector<std::vector<double>> times(methods.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const double before = threadTime_ns();
      methods[i].correct(pixels, found);
      times[i].push_back((threadTime_ns() - before) / static_cast<double>(pixels.size()));
    }
  }
  std::vector<double> medians;
  medians.reserve(times.size());
  for (std::vector<double>& all : times) medians.push_back(quantile(std::move(all), 0.5));
  return medians;
}

}  // namespace ardrone_vslam::bench
