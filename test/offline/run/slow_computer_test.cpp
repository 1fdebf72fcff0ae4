// SPDX-License-Identifier: BSD-3-Clause
#include "run/slow_computer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "run/run_all.hpp"
#include "summary/run_report.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

/// Stamps alone.
class Stamps : public Sequence {
 public:
  explicit Stamps(std::vector<int> stamps_ms) : stamps_ms_(std::move(stamps_ms)) {}
  std::string name() const override { return "stamps"; }
  std::size_t size() const override { return stamps_ms_.size(); }
  std::int64_t stamp_ns(std::size_t index) const override {
    return std::int64_t{1'000'000} * stamps_ms_.at(index);
  }
  cv::Mat image(std::size_t) override { return {}; }
  const CameraIntrinsics& camera() const override { return camera_; }
  Eigen::Isometry3d T_base_cam() const override { return Eigen::Isometry3d::Identity(); }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<OdometryState>& odometry() const override { return odometry_; }

 private:
  std::vector<int> stamps_ms_;
  CameraIntrinsics camera_;
  Trajectory truth_;
  std::vector<OdometryState> odometry_;
};

/// Stamps of the images that it takes.
std::vector<int> taken(const std::vector<int>& stamps_ms, SlowComputer& computer,
                       const std::vector<double>& measured_ms = {}) {
  const Stamps sequence(stamps_ms);
  std::vector<int> result;
  for (std::size_t i = 0; i < stamps_ms.size();) {
    const double cost_ms = result.size() < measured_ms.size() ? measured_ms[result.size()] : 0.0;
    result.push_back(stamps_ms[i]);
    i = computer.next(sequence, i, cost_ms);
  }
  return result;
}

using Images = std::vector<int>;

TEST(SlowComputer, HasTimeForAllImagesWhenItIsFastEnough) {
  SlowComputer computer({40.0, 1});
  EXPECT_EQ(taken({0, 50, 100, 150}, computer), (Images{0, 50, 100, 150}));
  EXPECT_EQ(computer.dropped(), 0);
}

TEST(SlowComputer, TakesTheNewestOfThoseThatCameMeanwhile) {
  SlowComputer computer({120.0, 1});
  // Busy until 120, 240, 360, 480.
  EXPECT_EQ(taken({0, 50, 100, 150, 200, 250, 300, 350, 400}, computer),
            (Images{0, 100, 200, 350, 400}));
  EXPECT_EQ(computer.dropped(), 4);
}

TEST(SlowComputer, WaitsForAnImageWhenItIsFree) {
  SlowComputer computer({60.0, 1});
  // Free at 60, at 510 the burst's first keeps it busy until 570.
  EXPECT_EQ(taken({0, 510, 520, 530, 600}, computer), (Images{0, 510, 530, 600}));
  EXPECT_EQ(computer.dropped(), 1);
}

TEST(SlowComputer, NeedsTheMeasuredTimeTimesTheFactor) {
  SlowComputer computer({std::nullopt, 10});
  EXPECT_EQ(taken({0, 50, 100, 150, 200}, computer, {10, 1, 1}), (Images{0, 100, 150, 200}));
  SlowComputer twice({60.0, 2});  // whatever is measured
  EXPECT_EQ(taken({0, 50, 100, 150, 200}, twice, {1, 1000, 1}), (Images{0, 100, 200}));
}

TEST(SlowComputer, TheLastImageIsNeverPassedBy) {
  SlowComputer computer({1e6, 1});
  EXPECT_EQ(taken({0, 50, 100, 150}, computer), (Images{0, 150}));
  EXPECT_EQ(computer.dropped(), 2);
}

class SlowRun : public testing::Test {
 protected:
  RunResult run(const std::optional<ComputerSpeed>& speed, int threads) {
    WorldOptions options;
    options.duration_s = 3;
    options.rate_hz = 20;
    WorldSequence world(options);
    const RunOdometry odometry = simulatedOdometry(world, "drone", 1);
    return runAll(
               world, PipelineConfig{}, {odometry}, threads,
               [this](std::size_t done, const ResultsSoFar&) { done_ = done; }, speed)
        .front();
  }

  std::size_t done_ = 0;
};

TEST_F(SlowRun, UsesTheImagesThatItHasTimeForAndCountsTheOthers) {
  const RunResult slow = run(ComputerSpeed{200.0, 1}, 2);
  ASSERT_EQ(slow.frames.size(), 16U);  // of 60: at 0, 0.2 .. 2.8 s and the last, at 2.95 s
  EXPECT_EQ(slow.frames_dropped_slow, 44);
  EXPECT_EQ(done_, 60U);
  for (std::size_t i = 0; i < 15; ++i) {
    const std::int64_t passed_ns =
        slow.frames[i].result.stamp_ns - slow.frames.front().result.stamp_ns;
    EXPECT_EQ((passed_ns + 500'000) / 1'000'000, static_cast<std::int64_t>(200 * i));
  }
  const auto summary = summaryOf(slow, evaluate(slow, {}), {"laps", "drone", 1, "msckf"});
  EXPECT_EQ(summary["frames_dropped_slow"], 44);
  EXPECT_EQ(summary["frames"], 16);
}

TEST_F(SlowRun, IsTheSameEachTimeWithABudget) {
  const RunResult one = run(ComputerSpeed{130.0, 1}, 1);
  const RunResult two = run(ComputerSpeed{130.0, 1}, 2);
  ASSERT_EQ(one.frames.size(), two.frames.size());
  for (std::size_t i = 0; i < one.frames.size(); ++i) {
    EXPECT_EQ(one.frames[i].result.stamp_ns, two.frames[i].result.stamp_ns);
    EXPECT_EQ(one.frames[i].result.T_map_base.matrix(), two.frames[i].result.T_map_base.matrix());
  }
}

TEST_F(SlowRun, MeasuresWhatAnImageCosts) {
  const RunResult slow = run(ComputerSpeed{std::nullopt, 1e6}, 1);
  EXPECT_EQ(slow.frames.size(), 2U) << "the first is not done before the last";
  EXPECT_EQ(slow.frames_dropped_slow, 58);
  EXPECT_EQ(run(std::nullopt, 1).frames_dropped_slow, 0);
}

}  // namespace
}  // namespace ardrone_vslam
