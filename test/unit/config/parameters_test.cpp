// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <type_traits>

#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/tracker.hpp"
#include "association/associator.hpp"

namespace ardrone_vslam {
namespace {

template <class Config>
class ParametersOf : public ::testing::Test {};
using Configs = ::testing::Types<TrackerConfig, SlamConfig>;
TYPED_TEST_SUITE(ParametersOf, Configs);

TYPED_TEST(ParametersOf, DefaultsAreValid) {
  EXPECT_TRUE(rangeFaults(TypeParam{}).empty());
  EXPECT_NO_THROW(validate(TypeParam{}));
}

TYPED_TEST(ParametersOf, NamesAreUniqueAndEverythingIsSaid) {
  TypeParam config;
  std::set<std::string> names;
  visitParameters(config, [&](const ParameterInfo& info, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    EXPECT_TRUE(names.insert(info.name).second) << info.name << " twice";
    EXPECT_STRNE(info.unit, "") << info.name;
    EXPECT_STRNE(info.effect, "") << info.name;
    if constexpr (std::is_enum_v<Value>) {
      EXPECT_STREQ(info.unit, "choice") << info.name;
    } else if constexpr (std::is_same_v<Value, bool>) {
      EXPECT_STREQ(info.unit, "switch") << info.name;
    } else {
      EXPECT_LT(info.min, info.max) << info.name;
    }
  });
  EXPECT_FALSE(names.empty());
}

/// Sets the numbers to values outside their ranges.
struct Spoil {
  int* count;

  template <class T>
  void operator()(const ParameterInfo& info, T& value) const {
    if constexpr (std::is_same_v<T, int>) {
      value = static_cast<int>(info.min) - 1;
      ++*count;
    } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, NumberOrAuto>) {
      value = *count % 2 == 0 ? std::nan("") : 2 * std::abs(info.max) + 1;
      ++*count;
    }
  }
};

TYPED_TEST(ParametersOf, EveryFaultIsListedOnce) {
  TypeParam config;
  int spoilt = 0;
  visitParameters(config, Spoil{&spoilt});
  try {
    validate(config);
    FAIL() << "must throw";
  } catch (const ConfigError& e) {
    EXPECT_EQ(static_cast<int>(e.faults().size()), spoilt);
    for (const std::string& fault : e.faults())
      EXPECT_NE(std::string(e.what()).find(fault), std::string::npos);
  }
}

TEST(Parameters, AFaultSaysNameValueAndRange) {
  SlamConfig config;
  config.msckf.height.height_sigma_m = 0;
  const auto faults = rangeFaults(config);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0], "height_sigma_m is 0 but must be between 0.0001 and 10 [m]");
}

TEST(Parameters, BothEndsOfARangeAreValid) {
  SlamConfig config;
  for (const int landmarks : {1, 1000}) {
    config.thesis_filter.min_landmarks = landmarks;
    EXPECT_NO_THROW(validate(config));
  }
}

TEST(Parameters, StagesRefuseInvalidConfigurations) {
  SlamConfig config;
  config.association.landmark_threshold_px = 0;
  config.odometry.buffer_s = -1;
  EXPECT_THROW(Associator{config.association}, ConfigError);
  EXPECT_THROW(OdometryBuffer{config.odometry}, ConfigError);
  try {
    Slam slam(config, Eigen::Isometry3d::Identity());
    FAIL() << "must throw";
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.faults().size(), 2U) << "all stages' faults at once";
  }
}

TEST(Parameters, NamesOfChoices) {
  EXPECT_STREQ(nameOf(EstimatorKind::kThesis), "thesis");
  EXPECT_STREQ(nameOf(EstimatorKind::kOdometry), "odometry");
  EXPECT_STREQ(nameOf(EstimatorKind::kMsckf), "msckf");
}

TEST(Parameters, NearestName) {
  const std::set<std::string> known{"threshold", "features_per_frame", "max_landmarks"};
  EXPECT_EQ(nearestName("thresold", known), "threshold");
  EXPECT_EQ(nearestName("landmarks", known), "max_landmarks");
  EXPECT_EQ(nearestName("feature_per_frames", known), "features_per_frame");
  EXPECT_EQ(nearestName("colour", known), "");
  EXPECT_EQ(nearestName("max", known), "") << "part of too many names";
}

}  // namespace
}  // namespace ardrone_vslam
