// SPDX-License-Identifier: BSD-3-Clause
// Wrong set-ups, flown: found, named, and the pose no worse than the odometry.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "run/run_all.hpp"
#include "run/run_odometry.hpp"
#include "sequences/drone_cameras.hpp"
#include "sequences/faulty_sequence.hpp"
#include "simulation/odometry_model.hpp"
#include "summary/run_report.hpp"
#include "support/median.hpp"
#include "support/shipped_profiles.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

WorldOptions laps() {
  WorldOptions options;
  options.duration_s = 12;
  options.rate_hz = 15;
  return options;
}

std::unique_ptr<Sequence> lapsWith(const std::string& fault, const WorldOptions& options = laps()) {
  auto sequence = std::make_unique<WorldSequence>(options);
  if (fault.empty()) return sequence;
  return withFault(std::move(sequence), fault);
}

struct Flown {
  RunResult run;
  double ratio = 0;  // fused over odometry
};

/// The same images with odometry of each seed.
std::vector<Flown> flyAll(const std::string& fault, const std::vector<std::uint64_t>& seeds,
                          const WorldOptions& options = laps(), const PipelineConfig& config = {}) {
  const auto sequence = lapsWith(fault, options);
  const Trajectory& truth = sequence->truth();
  std::vector<RunOdometry> odometry;
  for (const std::uint64_t seed : seeds) {
    odometry.push_back(
        {"drone", seed, simulateOdometry(truth, test::shippedProfile("drone"), seed)});
  }
  std::vector<Flown> flown;
  for (const RunResult& run : runAll(*sequence, config, odometry, 2, {})) {
    const auto summary = summaryOf(run, evaluate(run, truth), {"laps", "drone", 1, "msckf"});
    EXPECT_EQ(summary["setup_fault"], nameOf(run.setup.fault));
    flown.push_back({run, summary["fused_ate_rmse_m"].get<double>() /
                              summary["odometry_ate_rmse_m"].get<double>()});
  }
  return flown;
}

Flown fly(const std::string& fault, const WorldOptions& options = laps(), std::uint64_t seed = 1) {
  return flyAll(fault, {seed}, options).front();
}

TEST(SetupFaults, AreNamedAndDoNoHarm) {
  const std::vector<std::pair<std::string, SetupFault>> faults{
      {"yaw=180", SetupFault::kExtrinsics},
      {"roll=90", SetupFault::kExtrinsics},
      {"mirrored", SetupFault::kMirrored},
      {"late=0.3", SetupFault::kTimeOffset},
      {"late=-0.3", SetupFault::kTimeOffset}};
  for (const auto& [fault, expected] : faults) {
    const Flown flown = fly(fault);
    EXPECT_EQ(flown.run.setup.fault, expected) << fault;
    EXPECT_GT(flown.run.setup_fault_ns, 0) << fault;
    EXPECT_LT(flown.ratio, 1.05) << fault;
  }
}

TEST(SetupFaults, AreNotFoundWhereThereIsNone) {
  const Flown flown = fly("");
  EXPECT_EQ(flown.run.setup.fault, SetupFault::kNone);
  EXPECT_EQ(countDistrusted(flown.run), 0);
  EXPECT_LT(flown.ratio, 0.6);
}

// Over a plane a tilt looks much like a way sideways, and a fit may take either for the other.
TEST(SetupFaults, AreNotFoundLookingDownAtAFloor) {
  WorldOptions options = laps();
  options.camera = cameraNamed("bottom").intrinsics;
  options.T_body_cam = options.T_base_cam = cameraNamed("bottom").T_body_cam;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    options.seed = seed;
    EXPECT_EQ(countDistrusted(fly("", options, seed).run), 0) << "seed " << seed;
  }
}

// What is no fault yet is found, and taken out.
TEST(SetupFaults, ImagesThatAreALittleLateAreTakenAsSuch) {
  PipelineConfig as_stamped;
  as_stamped.mapper.image_time_offset_s = 0;
  // Of so short flights, half of which pass before it is known. Measured: 1.05 to 1.12, 0.52 to
  // 0.80.
  for (const auto& [late_s, most] : std::map<double, double>{{0.1, 1.15}, {0.2, 0.9}}) {
    const std::string fault = "late=" + std::to_string(late_s);
    const auto found = flyAll(fault, {1, 2, 3});
    const auto left = flyAll(fault, {1, 2, 3}, laps(), as_stamped);
    std::vector<double> gains;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].run.image_time_offset_s, -late_s, 0.015) << fault;
      EXPECT_GT(found[i].run.time_offset_found_ns, 0) << fault;
      gains.push_back(found[i].ratio / left[i].ratio);
    }
    EXPECT_LT(test::median(gains), most) << fault;
  }
}

TEST(SetupFaults, OdometryThatIsStampedLateIsFoundAndJudgedByTheImagesClock) {
  const auto sequence = lapsWith("");
  OdometryProfile late = test::shippedProfile("drone");
  late.delay_s = 0.1;
  const RunOdometry odometry{"drone", 1, simulateOdometry(sequence->truth(), late, 1)};
  const RunResult run = runAll(*sequence, PipelineConfig{}, {odometry}, 2, {}).front();
  EXPECT_NEAR(run.image_time_offset_s, 0.1, 0.015);
  for (const RunFrame& frame : run.frames) ASSERT_EQ(frame.exposed_ns(), frame.result.stamp_ns);
}

TEST(FaultySequence, MakesWhatIsAskedFor) {
  const auto right = lapsWith("");
  const auto late = lapsWith("late=0.3");
  EXPECT_EQ(late->stamp_ns(3), right->stamp_ns(3) + 300'000'000);
  const auto focal = lapsWith("focal=1.5");
  EXPECT_DOUBLE_EQ(focal->camera().fx_px, 1.5 * right->camera().fx_px);
  EXPECT_DOUBLE_EQ(focal->camera().cx_px, right->camera().cx_px);
  const auto turned = lapsWith("pitch=90");
  const Eigen::Matrix3d turn =
      right->T_base_cam().linear().transpose() * turned->T_base_cam().linear();
  EXPECT_TRUE(turn.isApprox(
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix(), 1e-9));
  const cv::Mat image = right->image(0);
  const cv::Mat mirrored = lapsWith("mirrored")->image(0);
  EXPECT_EQ(mirrored.at<std::uint8_t>(5, 7), image.at<std::uint8_t>(5, image.cols - 8));
}

TEST(FaultySequence, RefusesWhatItDoesNotKnow) {
  WorldOptions short_flight = laps();
  short_flight.duration_s = 0.2;
  for (const char* fault : {"", "late", "late=", "late=x", "focal=0", "focal=-1", "tilt=3"})
    EXPECT_THROW(withFault(lapsWith("", short_flight), fault), std::invalid_argument) << fault;
}

}  // namespace
}  // namespace ardrone_vslam
