// SPDX-License-Identifier: BSD-3-Clause
// vslam_onboard's loop when memory ends, at each place where it can.
#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <optional>

#include "counted_allocations.hpp"
#include "loop/onboard_loop.hpp"
#include "onboard/wall_flight.hpp"

namespace ardrone_vslam::test {
namespace {

class OutOfMemory : public WallFlight {
 protected:
  ~OutOfMemory() override { failing_allocation = -1; }

  /// @return allocations of the flight when the one of this number fails, from 1 on; 0: none does
  long fly(long failing) {
    loop_.emplace(settings_, stop_.ends[0]);
    const long before = allocations;
    failing_allocation = failing == 0 ? -1 : before + failing;
    EXPECT_TRUE(loop_->run());
    failing_allocation = -1;
    return allocations - before;
  }

  std::optional<OnboardLoop> loop_;
};

/// Not each of thousands, as emulated processors are slow.
long stepOf(long all) {
  return std::max(all / 60, 1L);
}

long countOf(const std::vector<VslamPose>& answers, std::uint32_t state) {
  return std::count_if(answers.begin(), answers.end(),
                       [&](const VslamPose& answer) { return answer.state == state; });
}

TEST_F(OutOfMemory, InFlightTheMapBeginsAnew) {
  const long all = fly(0);
  const auto untroubled = poses();
  ASSERT_EQ(untroubled.size(), kAlong + 1U);
  ASSERT_GT(untroubled[kAlong - 1].landmarks, 10U) << "there is no map to lose";
  ASSERT_GT(all, 100);
  for (long failing = 1; failing <= all; failing += stepOf(all)) {
    fly(failing);
    const auto answers = poses();
    ASSERT_EQ(countOf(answers, VSLAM_OUT_OF_MEMORY), 1) << "allocation " << failing;
    // One image at most was lost; the others have poses.
    const auto poses_given = std::count_if(answers.begin(), answers.end(), [](const auto& answer) {
      return answer.flags == VSLAM_POSE_IS_VALID;
    });
    ASSERT_GE(poses_given, kAlong - 1) << "allocation " << failing;
    ASSERT_EQ(answers.back().state, static_cast<std::uint32_t>(VSLAM_ENDING));
    ASSERT_GE(answers.back().frames_dropped, 1U);
  }
}

TEST_F(OutOfMemory, ALoadedMapIsNeitherLoadedAgainNorWrittenOver) {
  settings_.tracker.corners.features_per_frame = 100;
  settings_.save_map = file("map");
  fly(0);
  loop_->saveMap();
  const std::string map = readFile(file("map"));
  ASSERT_GT(map.size(), 1000U);
  settings_.map_file = file("map");
  const long all = fly(0);
  for (long failing = 1; failing <= all; failing += stepOf(all)) {
    fly(failing);
    const auto answers = poses();
    ASSERT_EQ(countOf(answers, VSLAM_OUT_OF_MEMORY), 1) << "allocation " << failing;
    ASSERT_NE(answers[kAlong - 1].state, static_cast<std::uint32_t>(VSLAM_SEARCHING_MAP));
    ASSERT_NE(loop_->saveMap().find("stays as it was"), std::string::npos);
    ASSERT_EQ(readFile(file("map")), map);
  }
}

TEST_F(OutOfMemory, AtTheStartItIsAnError) {
  OnboardLoop(settings_, stop_.ends[0]);  // some libraries keep what they allocate at first
  const long before = allocations;
  OnboardLoop(settings_, stop_.ends[0]);
  const long all = allocations - before;
  for (long failing = 1; failing <= all; failing += stepOf(all)) {
    failing_allocation = allocations + failing;
    EXPECT_THROW(OnboardLoop(settings_, stop_.ends[0]), std::bad_alloc) << "allocation " << failing;
    failing_allocation = -1;
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
