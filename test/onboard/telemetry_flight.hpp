// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "map/landmark_map.hpp"
#include "protocol/telemetry.hpp"
#include "protocol/telemetry_reader.hpp"

namespace ardrone_vslam::test {

using Bytes = std::vector<std::uint8_t>;

/// The drone's side: features and a map of random numbers, and what Telemetry makes of them.
struct TelemetryFlight {
  explicit TelemetryFlight(unsigned seed) : random(seed) {}

  void grow(int count) {
    for (int i = 0; i < count; ++i) {
      Landmark landmark;
      landmark.position_map = {metres(random), metres(random), metres(random)};
      landmark.sigma_m = static_cast<float>(std::abs(metres(random)));
      landmark.last_seen_ns = features.stamp_ns + 1;  // by the next image
      map.add(landmark);
    }
  }
  /// Any of them: the last ones take their places.
  void shrink(int count) {
    for (int i = 0; i < count && map.size() > 0; ++i)
      map.remove(map.all()[random() % map.size()].id);
  }
  /// Of the next image.
  Bytes next(std::size_t feature_count) {
    features.clear();
    features.stamp_ns += 33'333'333;
    for (std::size_t i = 0; i < feature_count; ++i) {
      features.pixel_px.emplace_back(pixels(random), pixels(random));
      features.age_frames.push_back(static_cast<std::uint16_t>(random() % 1000));
    }
    std::array<std::uint8_t, Telemetry::kBytes> datagram;
    const std::size_t size = telemetry.write(features, map.all(), datagram);
    return {datagram.begin(), datagram.begin() + static_cast<std::ptrdiff_t>(size)};
  }
  bool fly(TelemetryReader& reader) {
    const Bytes datagram = next(50);
    return reader.read(datagram.data(), datagram.size());
  }

  std::mt19937 random;
  std::uniform_real_distribution<double> metres{-20, 20};
  std::uniform_real_distribution<float> pixels{0, 639};
  ImageFeatures features;
  LandmarkMap map{LandmarkMapConfig{}};
  Telemetry telemetry;
};

}  // namespace ardrone_vslam::test
