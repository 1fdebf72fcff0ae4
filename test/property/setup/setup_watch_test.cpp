// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/setup_watch.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/rotation.hpp"
#include "support/turning_camera.hpp"

namespace ardrone_vslam {
namespace {

using test::PointCamera;
using test::Swaying;

constexpr double kWatchRate_hz = 20;
constexpr double kDegree = M_PI / 180;

/// A drone that turns, and flies at up to 1.5 m/s or so.
Swaying flightOf(std::uint64_t seed) {
  return Swaying(seed, 0.15, 1.2);
}

OdometryBuffer odometryOf(const Swaying& flight, std::uint64_t seed) {
  return test::swayOdometry(flight, 25, 100, {0.002, 0.002}, seed);
}

/// What is wrong with the images, or with what is told of them.
struct Fault {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // of the mounting, about the camera's axes
  bool is_mirrored = false;
  double late_s = 0;
  double focal_factor = 1;
};

Fault rotatedBy(double angle_deg, int axis) {
  Fault fault;
  fault.turn = rotationOf(angle_deg * kDegree * Eigen::Vector3d::Unit(axis));
  return fault;
}

Eigen::Isometry3d told(const Fault& fault) {
  Eigen::Isometry3d T_base_cam = test::forwardExtrinsics();
  T_base_cam.linear() = T_base_cam.linear() * fault.turn;
  return T_base_cam;
}

ImageFeatures look(PointCamera& camera, const Swaying& flight, double t_s, const Fault& fault) {
  ImageFeatures image = camera.look(flight.T_map_base(t_s), test::swayStamp_ns(t_s + fault.late_s));
  const auto factor = static_cast<float>(fault.focal_factor);
  image.focal_length_px *= factor;
  for (Eigen::Vector3f& bearing : image.bearing_cam) {
    if (fault.is_mirrored) bearing.x() = -bearing.x();
    bearing.head<2>() /= factor;
    bearing.normalize();
  }
  return image;
}

/// @return when the fault was found, or nothing
std::optional<double> film(SetupWatch& watch, const Swaying& flight, const OdometryBuffer& odometry,
                           const Fault& fault, double from_s, double to_s, std::uint64_t seed) {
  PointCamera camera(seed);
  std::optional<double> found_s;
  for (double t_s = from_s; t_s < to_s; t_s += 1 / kWatchRate_hz) {
    watch.see(look(camera, flight, t_s, fault), odometry);
    if (!found_s && watch.finding().fault != SetupFault::kNone) found_s = t_s;
  }
  return found_s;
}

/// @return what is known after 15 s, found within 5 s
SetupFinding findOf(const Fault& fault, std::uint64_t seed) {
  const Swaying flight = flightOf(seed);
  const OdometryBuffer odometry = odometryOf(flight, seed);
  SetupWatch watch(told(fault));
  const auto found_s = film(watch, flight, odometry, fault, 0, 15, seed);
  EXPECT_LE(found_s.value_or(100), 5) << "seed " << seed;
  return watch.finding();
}

TEST(SetupWatch, FindsACameraThatIsTurnedAndHow) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double angle_deg : {90.0, -90.0, 180.0}) {
        const SetupFinding found = findOf(rotatedBy(angle_deg, axis), seed);
        ASSERT_EQ(found.fault, SetupFault::kExtrinsics) << angle_deg << " about " << axis;
        EXPECT_EQ(found.rival, SetupFault::kNone) << angle_deg << " about " << axis;
        EXPECT_TRUE(found.T_base_cam.isApprox(test::forwardExtrinsics(), 1e-9));
      }
    }
  }
}

TEST(SetupWatch, FindsMirroredImages) {
  Fault fault;
  fault.is_mirrored = true;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const SetupFinding found = findOf(fault, seed);
    EXPECT_EQ(found.fault, SetupFault::kMirrored);
    EXPECT_EQ(found.rival, SetupFault::kNone);
  }
}

TEST(SetupWatch, FindsStampsThatAreOff) {
  for (const double late_s : {0.3, -0.3}) {
    Fault fault;
    fault.late_s = late_s;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const SetupFinding found = findOf(fault, seed);
      EXPECT_EQ(found.fault, SetupFault::kTimeOffset);
      EXPECT_NEAR(found.offset_s, -late_s, 0.05);
    }
  }
}

TEST(SetupWatch, FindsAWrongFocalLength) {
  for (const double factor : {0.6, 1.75}) {
    Fault fault;
    fault.focal_factor = factor;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const SetupFinding found = findOf(fault, seed);
      EXPECT_EQ(found.fault, SetupFault::kFocalLength) << "factor " << factor;
      EXPECT_NEAR(found.focal_factor / factor, 1, 0.26);
    }
  }
}

TEST(SetupWatch, FindsImagesThatStandStillInFlightAndTheirEnd) {
  for (const std::uint64_t seed : {1, 2, 3, 5}) {  // of 4 the image after 10 s has 16 tracks only
    const Swaying flight = flightOf(seed);
    const OdometryBuffer odometry = odometryOf(flight, seed);
    SetupWatch watch(test::forwardExtrinsics());
    ASSERT_FALSE(film(watch, flight, odometry, {}, 0, 10, seed));
    PointCamera camera(seed);
    ImageFeatures image = look(camera, flight, 10, {});
    std::optional<double> found_s;
    for (double t_s = 10; t_s < 15; t_s += 1 / kWatchRate_hz) {
      image.stamp_ns = test::swayStamp_ns(t_s);
      watch.see(image, odometry);
      if (!found_s && watch.finding().fault == SetupFault::kStillImages) found_s = t_s;
    }
    EXPECT_LE(found_s.value_or(100), 13) << "seed " << seed;
    film(watch, flight, odometry, {}, 15, 20, seed);
    EXPECT_EQ(watch.finding().fault, SetupFault::kNone) << "seed " << seed;
  }
}

TEST(SetupWatch, FindsOdometryOfAnotherFlight) {
  const Swaying flight = flightOf(1);
  const OdometryBuffer odometry = odometryOf(flightOf(2), 2);
  SetupWatch watch(test::forwardExtrinsics());
  EXPECT_LE(film(watch, flight, odometry, {}, 0, 15, 1).value_or(100), 10);
  EXPECT_EQ(watch.finding().fault, SetupFault::kUnknown);
}

TEST(SetupWatch, FindsNothingWhereNothingIsWrongAndSaysSo) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Swaying flight = flightOf(seed);
    SetupWatch watch(test::forwardExtrinsics());
    EXPECT_FALSE(film(watch, flight, odometryOf(flight, seed), {}, 0, 15, seed)) << "seed " << seed;
    EXPECT_TRUE(watch.finding().is_confirmed) << "seed " << seed;
  }
}

TEST(SetupWatch, ClocksATenthOfASecondApartAreNoFault) {
  Fault fault;
  fault.late_s = 0.1;
  const Swaying flight = flightOf(3);
  SetupWatch watch(test::forwardExtrinsics());
  EXPECT_FALSE(film(watch, flight, odometryOf(flight, 3), fault, 0, 15, 3));
}

TEST(SetupWatch, TheParameterIsTakenIntoAccount) {
  Fault fault;
  fault.late_s = 0.3;
  const Swaying flight = flightOf(3);
  SetupWatch watch(test::forwardExtrinsics(), -0.3);
  EXPECT_FALSE(film(watch, flight, odometryOf(flight, 3), fault, 0, 15, 3));
}

TEST(SetupWatch, AFaultEndsWhenTheContradictionEnds) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Swaying flight = flightOf(seed);
    const OdometryBuffer odometry = odometryOf(flight, seed);
    SetupWatch watch(test::forwardExtrinsics());
    Fault fault;
    fault.is_mirrored = true;
    ASSERT_TRUE(film(watch, flight, odometry, fault, 0, 10, seed));
    film(watch, flight, odometry, {}, 10, 15, seed);
    EXPECT_EQ(watch.finding().fault, SetupFault::kNone) << "seed " << seed;
  }
}

TEST(SetupWatch, TurningOnTheSpotDoesNotTellMirroredImagesFromATurnedCamera) {
  Fault fault;
  fault.is_mirrored = true;
  const Swaying flight(1, 0.15, 0);
  SetupWatch watch(test::forwardExtrinsics());
  EXPECT_TRUE(film(watch, flight, odometryOf(flight, 1), fault, 0, 15, 1));
  const SetupFinding found = watch.finding();
  EXPECT_NE(found.rival, SetupFault::kNone);
  EXPECT_NE(explain(found, "base", "camera").find("the images are mirrored"), std::string::npos);
}

TEST(SetupWatch, FrozenOdometryIsNoFaultOfTheSetUp) {
  const Swaying flight = flightOf(1);
  const Swaying standing(1, 0, 0);
  const OdometryBuffer odometry = test::swayOdometry(standing, 25, 100, {}, 1);
  SetupWatch watch(test::forwardExtrinsics());
  EXPECT_FALSE(film(watch, flight, odometry, {}, 0, 15, 1));
}

TEST(SetupWatch, StampsThatGoBackBeginAnew) {
  Fault fault;
  fault.is_mirrored = true;
  const Swaying flight = flightOf(2);
  const OdometryBuffer odometry = odometryOf(flight, 2);
  SetupWatch watch(test::forwardExtrinsics());
  film(watch, flight, odometry, {}, 0, 10, 2);
  EXPECT_LE(film(watch, flight, odometry, fault, 0, 10, 2).value_or(100), 6);
}

TEST(SetupFindingText, NamesTheFaultAndWhatHelps) {
  SetupFinding finding;
  EXPECT_EQ(explain(finding, "base_link", "camera"), "");
  finding.fault = SetupFault::kExtrinsics;
  finding.T_base_cam = test::forwardExtrinsics();
  finding.T_base_cam.translation() << 0.21, 0, 0;
  EXPECT_NE(explain(finding, "base_link", "camera")
                .find("static_transform_publisher 0.21 0 0 -1.5708 0 -1.5708 base_link camera"),
            std::string::npos)
      << explain(finding, "base_link", "camera");
  finding.fault = SetupFault::kTimeOffset;
  finding.offset_s = -0.28;
  EXPECT_NE(explain(finding, "b", "c").find("image_time_offset_s: -0.28"), std::string::npos);
  finding.fault = SetupFault::kFocalLength;
  finding.focal_factor = 1.5;
  EXPECT_NE(explain(finding, "b", "c").find("about 1.5 times the true one"), std::string::npos);
  finding.fault = SetupFault::kOdometryPosition;
  EXPECT_NE(explain(finding, "b", "c").find("odometry_mode to twist"), std::string::npos);
}

/// The flight's odometry, 100 a second, with a yaw that walks; the walk is appended to yaw_rad.
OdometryBuffer withWalkingYaw(const Swaying& flight, double seconds, std::uint64_t seed,
                              std::vector<double>& yaw_rad) {
  OdometryBufferConfig all;
  all.buffer_s = 2 * seconds;
  OdometryBuffer buffer(all);
  RandomSource random(seed, 9);
  double off_rad = 0;
  for (int i = 0; i <= 100 * seconds; ++i) {
    OdometryState state;
    state.stamp_ns = test::swayStamp_ns(0.01 * i);
    state.T_odom_base = flight.T_map_base(0.01 * i);
    state.T_odom_base.linear() = rotationOf({0, 0, off_rad}) * state.T_odom_base.linear();
    buffer.push(state);
    yaw_rad.push_back(off_rad);
    off_rad += 0.003 * random.normal();
  }
  return buffer;
}

TEST(SetupWatch, TellsHowFarTheOdometrysYawIsOff) {
  constexpr double kSeconds = 20;
  double squares = 0;
  double drawn = 0;
  int pairs = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Swaying flight = flightOf(seed);
    std::vector<double> yaw_rad;
    const OdometryBuffer odometry = withWalkingYaw(flight, kSeconds, seed, yaw_rad);
    const auto yawAt = [&](std::int64_t stamp_ns) {
      const double place = static_cast<double>(stamp_ns - test::swayStamp_ns(0)) * 1e-7;
      return yaw_rad.at(static_cast<std::size_t>(std::lround(place)));
    };
    SetupWatch watch(test::forwardExtrinsics());
    PointCamera camera(seed);
    std::int64_t last_ns = 0;
    for (int i = 0; i < kWatchRate_hz * (kSeconds - 1); ++i) {
      watch.see(look(camera, flight, i / kWatchRate_hz, {}), odometry);
      const SeenYaw yaw = watch.finding().yaw;
      if (yaw.stamp_ns == last_ns) continue;
      last_ns = yaw.stamp_ns;
      const double walked_rad =
          yawAt(yaw.stamp_ns) - yawAt(yaw.stamp_ns - std::llround(yaw.span_s * 1e9));
      // The images turned less than the odometry says by what its yaw walked.
      squares += (yaw.off_rad + walked_rad) * (yaw.off_rad + walked_rad) / yaw.variance_rad2;
      drawn += walked_rad * walked_rad / yaw.variance_rad2;
      ++pairs;
    }
  }
  ASSERT_GT(pairs, 200);
  EXPECT_LT(squares / pairs, 1.5);
  EXPECT_GT(drawn, 2 * squares) << "or the test would not tell";
}

}  // namespace
}  // namespace ardrone_vslam
