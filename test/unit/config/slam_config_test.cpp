// SPDX-License-Identifier: BSD-3-Clause
// Parameters of Slam that contradict each other are refused by name, with what helps.
#include <gtest/gtest.h>

#include "ardrone_vslam/slam.hpp"

namespace ardrone_vslam {
namespace {

std::vector<std::string> faultsOf(const SlamConfig& config) {
  try {
    Slam(config, Eigen::Isometry3d::Identity());
  } catch (const ConfigError& e) {
    return e.faults();
  }
  return {};
}

/// One fault that has all the words.
void expectFault(const SlamConfig& config, const std::vector<std::string>& words) {
  const std::vector<std::string> faults = faultsOf(config);
  ASSERT_EQ(faults.size(), 1U) << words.front();
  for (const std::string& word : words)
    EXPECT_NE(faults[0].find(word), std::string::npos) << faults[0] << "\nhas no " << word;
}

TEST(SlamConfig, TheThesisFilterRefusesWhatItWouldNotUse) {
  SlamConfig config;
  config.height_input.use_range = true;
  EXPECT_TRUE(faultsOf(config).empty());
  config.estimator = EstimatorKind::kThesis;
  expectFault(config, {"use_range", "estimator to msckf", "use_range to false"});
  config.height_input.use_range = false;
  config.height_input.known_height_m = 1.65;
  expectFault(config, {"known_height_m", "estimator to msckf", "known_height_m to 0"});
  config.height_input.known_height_m = 0;
  config.msckf.height.floor_points = true;
  config.height_input.use_range = true;
  EXPECT_EQ(faultsOf(config).size(), 2U) << "all faults are told at once";
}

TEST(SlamConfig, TheOdometryIsARowBesideTheOthersWithTheirParameters) {
  SlamConfig config;
  config.estimator = EstimatorKind::kOdometry;
  config.height_input.use_range = true;
  EXPECT_TRUE(faultsOf(config).empty());
}

TEST(SlamConfig, OneHeightIsEnough) {
  SlamConfig config;
  config.height_input.use_range = true;
  config.height_input.known_height_m = 1.65;
  expectFault(config, {"use_range and known_height_m exclude each other"});
  config.height_input.use_range = false;
  config.height_input.use_navdata_height = true;
  expectFault(config, {"use_navdata_height and known_height_m exclude each other"});
  config.height_input.known_height_m = 0;
  config.height_input.use_range = true;
  expectFault(config, {"use_range and use_navdata_height exclude each other"});
}

TEST(SlamConfig, PlanarIsAHeightOfTheMsckfAndAModeOfTheThesisFilter) {
  SlamConfig config;
  config.planar = true;
  EXPECT_TRUE(faultsOf(config).empty());
  config.msckf.height.floor_points = true;
  expectFault(config, {"floor_points needs a height"});
  config.msckf.height.floor_points = false;
  config.height_input.use_range = true;
  expectFault(config, {"planar and use_range exclude each other", "use_range to false"});
  config.height_input.use_range = false;
  config.estimator = EstimatorKind::kThesis;
  EXPECT_TRUE(faultsOf(config).empty());
}

TEST(SlamConfig, FloorPointsNeedAHeightAndTheMsckf) {
  SlamConfig config;
  config.msckf.height.floor_points = true;
  expectFault(config,
              {"floor_points needs a height", "use_range", "use_navdata_height", "known_height_m"});
  config.height_input.known_height_m = 1.2;
  EXPECT_TRUE(faultsOf(config).empty());
  config.estimator = EstimatorKind::kThesis;
  EXPECT_EQ(faultsOf(config).size(), 2U) << "the height is none of its, either";
}

TEST(SlamConfig, ALoadedMapMustNotBeTooLarge) {
  constexpr std::size_t kMost = 10;
  SlamConfig config;
  config.landmark_map.max_landmarks = kMost;
  EXPECT_TRUE(faultOfMaps(config, kMost).empty());
  const std::string fault = faultOfMaps(config, kMost + 1);
  for (const char* word : {"11 landmarks", "allows 10:", "prune --most"})
    EXPECT_NE(fault.find(word), std::string::npos) << fault << "\nhas no " << word;
  SavedMap map;
  map.landmarks.resize(kMost + 1);
  EXPECT_THROW(Slam(config, Eigen::Isometry3d::Identity()).load(map), std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
