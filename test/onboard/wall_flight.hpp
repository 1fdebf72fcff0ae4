// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "onboard/flight_fixture.hpp"

namespace ardrone_vslam::test {

/// A flight along a wall, so that there is a map.
class WallFlight : public FlightFixture {
 protected:
  WallFlight() {
    constexpr int kStep_px = 6;
    const TestImage wall = generatedImage(160 + kStep_px * kAlong, 120);
    std::string frames;
    std::string odometry;
    for (int i = -1; i <= kAlong; ++i) {
      VslamObserver state = odometryAt(stampOf(i), static_cast<std::uint32_t>(i + 10));
      state.position_m[1] = -0.1 * i;
      const Record record = recordOf(state);
      odometry.append(record.begin(), record.end());
      if (i < 0 || i == kAlong) continue;
      TestImage image(160, 120);
      for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) image.at(x, y) = wall.at(x + kStep_px * i, y);
      frames += pgm(stampOf(i), image);
    }
    writeFile(file("frames"), frames);
    writeFile(file("odometry"), odometry);
    settings_.onboard.observer = file("odometry");
    settings_.tracker.corners.features_per_frame = 30;
    settings_.mapper.landmark_map.max_landmarks = 1000;
  }
  ~WallFlight() override {
    for (const char* name : {"odometry", "loaded"}) std::remove(file(name).c_str());
  }

  static constexpr int kAlong = 40;  // images
};

}  // namespace ardrone_vslam::test
