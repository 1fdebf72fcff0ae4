// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "simulation/odometry_model.hpp"
#include "support/shipped_profiles.hpp"
#include "support/temporary_folder.hpp"

namespace ardrone_vslam {
namespace {

std::string faultOfLoading(const std::string& name, const std::string& yaml) {
  const TemporaryFolder folder;
  folder.write("profiles.yaml", yaml);
  try {
    loadOdometryProfile(name, folder.file("profiles.yaml"));
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

TEST(OdometryProfile, FaultsNameTheFileTheKeyAndWhatIsKnown) {
  EXPECT_NE(faultOfLoading("c", "a: {}\nb: {}").find("known are a, b"), std::string::npos);
  EXPECT_NE(faultOfLoading("a", "a: {scale: 1}").find("'scale' is not known"), std::string::npos);
  EXPECT_NE(faultOfLoading("a", "a: {rate_hz: 0}").find("'rate_hz' is out of range"),
            std::string::npos);
  EXPECT_NE(faultOfLoading("a", "a: {loss: 1}").find("'loss' is out"), std::string::npos);
  EXPECT_NE(faultOfLoading("a", "a: {rate_hz: fast}").find("'rate_hz' has a value"),
            std::string::npos);
  EXPECT_NE(faultOfLoading("a", "a: [").find("not valid YAML"), std::string::npos);
  EXPECT_THROW(loadOdometryProfile("drone", "/nowhere.yaml"), std::runtime_error);
}

TEST(OdometryProfile, AnglesAndTimesAreConverted) {
  const OdometryProfile drone = test::shippedProfile("drone");
  EXPECT_NEAR(drone.yaw_walk_rad_per_sqrt_s * std::sqrt(60), test::kRadPerDeg, 1e-12);
  EXPECT_NEAR(drone.attitude_bias_rad, 0.3 * test::kRadPerDeg, 1e-12);
  EXPECT_EQ(drone.rate_hz, 200);
  EXPECT_NEAR(test::shippedProfile("wheel").yaw_walk_rad_per_sqrt_m, 0.02 * test::kRadPerDeg,
              1e-12);
}

}  // namespace
}  // namespace ardrone_vslam
