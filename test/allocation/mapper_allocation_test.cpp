// SPDX-License-Identifier: BSD-3-Clause
// The mapper's frames once the map is complete: they take small blocks for a while, a bounded
// number of them, and give all of them back.
#include <gtest/gtest.h>

#include <algorithm>

#include "counted_allocations.hpp"
#include "support/heap_in_use.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kLapFrames = 100;
constexpr int kWarmUpLaps = 7;

class MapperAllocation : public ::testing::Test {
 protected:
  MapperAllocation()
      : flight_(test::lapsFlight(kLapFrames, kWarmUpLaps + 2, 10)),
        odometry_(test::observe(flight_, {}, 2)) {
    PointWorld world = test::pointRoom(1);
    frames_ = test::film(world, flight_);
  }
  /// @return of the lap's frames, what each allocates
  std::vector<long> flyLap() {
    std::vector<long> counts;
    for (int i = 0; i < kLapFrames; ++i, ++next_) {
      const long before = allocations;
      slam_.process(frames_[next_], odometry_[next_], {},
                    [this] { return 1e-3 * static_cast<double>(next_); });
      counts.push_back(allocations - before);
    }
    return counts;
  }

  static SlamConfig config() {
    SlamConfig config;
    config.landmark_map.max_landmarks = 2000;    // more than there are
    config.frame_budget.frame_budget_ms = 1000;  // there is always time, but that is asked
    return config;
  }

  test::Flight flight_;
  std::vector<OdometryState> odometry_;
  std::vector<ImageFeatures> frames_;
  Slam slam_{config(), test::forwardExtrinsics()};
  std::size_t next_ = 0;
};

TEST_F(MapperAllocation, IsBoundedAndGivenBack) {
  slam_.reserveMap();  // it grows by blocks of 256 landmarks
  for (int lap = 0; lap < kWarmUpLaps; ++lap) flyLap();
  const std::size_t landmarks = slam_.landmarks().size();
  ASSERT_GT(landmarks, 800U);
  flyLap();
  const std::size_t heap_bytes = test::heapInUse_bytes();
  const std::vector<long> counts = flyLap();
  EXPECT_LT(slam_.landmarks().size(), landmarks + landmarks / 20) << "the map is not complete";
  const long most = *std::max_element(counts.begin(), counts.end());
  std::printf("blocks allocated by a frame: %ld at most\n", most);
  EXPECT_LE(most, 230);  // measured: 186
  const long grown_bytes =
      static_cast<long>(test::heapInUse_bytes()) - static_cast<long>(heap_bytes);
  std::printf("heap in use: %ld bytes more after a lap\n", grown_bytes);
  EXPECT_LT(grown_bytes, 16'384) << "of a lap of " << kLapFrames << " frames";
}

}  // namespace
}  // namespace ardrone_vslam
