// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_odometry.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "doctor/streams/doctor_height.hpp"
#include "support/doctor_findings.hpp"
#include "support/doctor_recordings.hpp"

namespace ardrone_vslam {
namespace {

using Names = std::set<std::string>;
using Parameters = std::vector<SuggestedParameter>;
using test::found;
using test::goodRecording;
using test::verdictOf;

template <class Change>
DoctorRecording changed(Change change) {
  DoctorRecording recording = goodRecording();
  for (std::size_t i = 0; i < recording.odometry.size(); ++i) {
    change(i, *recording.odometry[i].state);
  }
  return recording;
}

Findings odometryFindings(const DoctorRecording& recording) {
  Parameters parameters;
  Findings findings = checkOdometryValues(recording);
  for (const Finding& f : checkOdometryFields(recording, parameters)) findings.push_back(f);
  findings.push_back(checkOdometryYaw(recording, parameters));
  for (const Finding& f : checkHeight(recording, parameters)) findings.push_back(f);
  return findings;
}

TEST(DoctorOdometry, SoundOdometryHasNoFault) {
  for (const Finding& finding : odometryFindings(goodRecording())) {
    EXPECT_EQ(finding.verdict, Verdict::kOk) << finding.check << ": " << finding.text;
  }
}

TEST(DoctorOdometry, WithoutMotionNothingIsOk) {
  const auto still = changed([](std::size_t, OdometryState& state) {
    state.T_odom_base.setIdentity();
    state.twist_base.setZero();
  });
  const Findings findings = odometryFindings(still);
  for (const std::string check :
       {"odometry_unit", "odometry_turn_rate", "odometry_yaw", "height_metres", "height_ground"}) {
    EXPECT_EQ(verdictOf(findings, check), Verdict::kNotChecked) << check;
  }
  EXPECT_TRUE(checkOdometryValues(DoctorRecording()).empty());
}

TEST(DoctorOdometry, FindsTheMirroredYaw) {
  // y of a path that is integrated with -yaw, from the first pose on.
  Eigen::Vector3d position = goodRecording().odometry[0].state->T_odom_base.translation();
  const auto mirrored = changed([&position](std::size_t i, OdometryState& state) {
    const Eigen::Matrix3d R = state.T_odom_base.linear();
    const double yaw = std::atan2(R(1, 0), R(0, 0));
    if (i > 0) {
      position += 0.01 * (rotationOf({0, 0, -2 * yaw}) * R * state.twist_base.head<3>());
    }
    state.T_odom_base.translation().head<2>() = position.head<2>();
  });
  EXPECT_EQ(found(odometryFindings(mirrored)), Names{"odometry_yaw"});
  Parameters parameters;
  checkOdometryYaw(mirrored, parameters);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].key + " " + parameters[0].value, "odometry_mode twist");
}

TEST(DoctorOdometry, FindsATwistInOdomsAxes) {
  const auto unturned = changed([](std::size_t, OdometryState& state) {
    state.twist_base.head<3>() = state.T_odom_base.linear() * state.twist_base.head<3>();
  });
  Parameters parameters;
  const Finding finding = checkOdometryYaw(unturned, parameters);
  EXPECT_EQ(finding.verdict, Verdict::kWarning);
  EXPECT_NE(finding.text.find("axes of odom"), std::string::npos);
  // Which a configuration made for the driver's faults must not change.
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].key + " " + parameters[0].value, "odometry_mode pose");
}

TEST(DoctorOdometry, FindsJumps) {
  const auto far = changed([](std::size_t i, OdometryState& state) {
    if (i > 600) state.T_odom_base.translation().x() += 1e9;
  });
  EXPECT_EQ(found(odometryFindings(far)), Names{"odometry_jumps"});
  const auto near = changed([](std::size_t i, OdometryState& state) {
    if (i > 600) state.T_odom_base.translation().x() += 3;
  });
  EXPECT_EQ(found(odometryFindings(near)), Names{"odometry_jumps"});
}

TEST(DoctorOdometry, FindsMillimetres) {
  const auto millimetres =
      changed([](std::size_t, OdometryState& state) { state.T_odom_base.translation() *= 1000; });
  EXPECT_EQ(verdictOf(checkOdometryValues(millimetres), "odometry_unit"), Verdict::kFault);
}

TEST(DoctorOdometry, FindsWhatIsNotFilled) {
  const auto empty = changed([](std::size_t, OdometryState& state) {
    state.covariance.setZero();
    state.twist_base.tail<3>().setZero();
  });
  EXPECT_EQ(found(odometryFindings(empty)), (Names{"odometry_covariance", "odometry_turn_rate"}));
  const auto unknown = changed([](std::size_t, OdometryState& state) { state.covariance *= 1e9; });
  EXPECT_EQ(found(odometryFindings(unknown)), Names{"odometry_covariance"});
}

TEST(DoctorOdometry, CountsWhatIsNotFinite) {
  DoctorRecording recording = goodRecording();
  for (std::size_t i = 0; i < 5; ++i) recording.odometry[100 * i].state.reset();
  EXPECT_EQ(verdictOf(checkOdometryValues(recording), "odometry_values"), Verdict::kWarning);
  for (DoctorOdometry& odometry : recording.odometry) odometry.state.reset();
  EXPECT_EQ(verdictOf(checkOdometryValues(recording), "odometry_values"), Verdict::kFault);
  EXPECT_NO_FATAL_FAILURE(odometryFindings(recording));
}

TEST(DoctorHeight, FindsWholeMetres) {
  const auto whole = changed([](std::size_t, OdometryState& state) {
    double& z_m = state.T_odom_base.translation().z();
    z_m = std::trunc(z_m);
  });
  const Findings findings = odometryFindings(whole);
  EXPECT_EQ(found(findings), Names{"height_metres"});
  EXPECT_EQ(verdictOf(findings, "height_ground"), Verdict::kNotChecked);
}

TEST(DoctorHeight, FindsTheStepOverATable) {
  const auto table = changed([](std::size_t i, OdometryState& state) {
    if (i > 400 && i < 700) state.T_odom_base.translation().z() -= 0.75;
  });
  const Findings findings = odometryFindings(table);
  EXPECT_EQ(found(findings), Names{"height_ground"});
  EXPECT_NE(test::findingOf(findings, "height_ground").text.find("2 steps of up to 7"),
            std::string::npos)
      << test::findingOf(findings, "height_ground").text;
}

TEST(DoctorHeight, FindsTheStepBehindWholeMetresByTheDronesOwnAltitude) {
  DoctorRecording recording = goodRecording();
  for (std::size_t i = 0; i < recording.odometry.size(); ++i) {
    double& z_m = recording.odometry[i].state->T_odom_base.translation().z();
    if (i > 400 && i < 700) z_m -= 0.75;
    NavdataReading reading;
    reading.measured.height_m = z_m;
    recording.navdata.push_back({recording.odometry[i].time, reading});
    z_m = std::trunc(z_m);
  }
  EXPECT_EQ(found(odometryFindings(recording)), (Names{"height_metres", "height_ground"}));
}

TEST(DoctorHeight, KnowsTheDronesAltitudeByItsMillimetres) {
  const auto millimetres = changed([](std::size_t, OdometryState& state) {
    double& z_m = state.T_odom_base.translation().z();
    z_m = std::trunc(z_m * 1000) / 1000;
  });
  EXPECT_EQ(found(odometryFindings(millimetres)), Names{"height_ground"});
}

}  // namespace
}  // namespace ardrone_vslam
