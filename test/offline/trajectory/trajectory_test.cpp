// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/trajectory.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace ardrone_vslam {
namespace {

StampedPose pose(std::int64_t stamp_ns, double x_m, double yaw_rad) {
  StampedPose result;
  result.stamp_ns = stamp_ns;
  result.T_frame_body =
      Eigen::Translation3d(x_m, 0, 0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  return result;
}

std::string faultOfReading(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("fault.txt", text);
  try {
    readTum(folder.file("fault.txt"));
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

TEST(Trajectory, InterpolatesPositionLinearlyAndOrientationBySlerp) {
  const Trajectory trajectory({pose(1000, 1, 0.2), pose(2000, 3, 0.6)});
  const Eigen::Isometry3d middle = trajectory.at(1250);
  EXPECT_NEAR(middle.translation().x(), 1.5, 1e-12);
  const Eigen::AngleAxisd turn(middle.linear());
  EXPECT_NEAR(turn.angle() * turn.axis().z(), 0.3, 1e-12);
}

TEST(Trajectory, HoldsTheEndsOutsideTheCoveredTime) {
  const Trajectory trajectory({pose(1000, 1, 0.2), pose(2000, 3, 0.6)});
  EXPECT_TRUE(trajectory.at(0).isApprox(pose(0, 1, 0.2).T_frame_body, 1e-15));
  EXPECT_TRUE(trajectory.at(5000).isApprox(pose(0, 3, 0.6).T_frame_body, 1e-15));
}

TEST(Trajectory, RefusesStampsThatDoNotAscendAndPosesThatAreNotFinite) {
  EXPECT_THROW(Trajectory({pose(5, 0, 0), pose(5, 0, 0)}), std::invalid_argument);
  EXPECT_THROW(Trajectory({pose(5, 0, 0), pose(4, 0, 0)}), std::invalid_argument);
  EXPECT_THROW(Trajectory({pose(5, std::numeric_limits<double>::quiet_NaN(), 0)}),
               std::invalid_argument);
  Trajectory trajectory;
  trajectory.append(pose(5, 0, 0));
  EXPECT_THROW(trajectory.append(pose(5, 1, 0)), std::invalid_argument);
  EXPECT_EQ(trajectory.size(), 1U);
}

TEST(TumFile, KeepsNanosecondsAtTodaysEpoch) {
  const TemporaryFolder folder;
  const std::string path = folder.file("poses.txt");
  const Trajectory written({pose(1700000000123456789, 1.5, 0.5), pose(1700000000123456790, 2, 3)});
  writeTum(path, written);
  const Trajectory read = readTum(path);
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.poses()[i].stamp_ns, written.poses()[i].stamp_ns);
    EXPECT_TRUE(read.poses()[i].T_frame_body.isApprox(written.poses()[i].T_frame_body, 1e-8));
  }
}

TEST(TumFile, LinesOfAnyLengthAreWhole) {
  const TemporaryFolder folder;
  const std::string path = folder.file("poses.txt");
  writeTum(path, Trajectory({pose(1, 1e300, 0), pose(2, -1.5, 0)}));
  std::ifstream stream(path);
  std::string line;
  std::getline(stream, line);
  std::getline(stream, line);
  EXPECT_EQ(line.substr(line.size() - 48, 48), " 0.000000000 0.000000000 0.000000000 1.000000000");
  std::getline(stream, line);
  EXPECT_EQ(line,
            "0.000000002 -1.500000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000");
}

TEST(TumFile, ReadsCommentsBlankLinesExponentsAndNegativeStamps) {
  const TemporaryFolder folder;
  const std::string path = folder.file("poses.txt");
  folder.write("poses.txt", "# head\n\n-0.5 0 0 0 0 0 0 1 # tail\r\n1.5e+00 1 2 3 0 0 0 1\n");
  const Trajectory trajectory = readTum(path);
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory.poses()[0].stamp_ns, -500000000);
  EXPECT_EQ(trajectory.poses()[1].stamp_ns, 1500000000);
  EXPECT_EQ(trajectory.poses()[1].T_frame_body.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(TumFile, NamesFileLineAndFault) {
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_NE(faultOfReading(good + "2 0 0 0 0 0 0\n").find("fault.txt:2: eight"), std::string::npos);
  EXPECT_NE(faultOfReading(good + "2 0 nan 0 0 0 0 1\n").find(":2: eight finite"),
            std::string::npos);
  EXPECT_NE(faultOfReading("x 0 0 0 0 0 0 1\n").find(":1: the stamp 'x'"), std::string::npos);
  EXPECT_NE(faultOfReading(good + good).find(":2: the stamp 1.000000000 s does not come after"),
            std::string::npos);
  EXPECT_NE(faultOfReading("1 0 0 0 0 0 0 2\n").find(":1: the quaternion"), std::string::npos);
  EXPECT_NE(
      faultOfReading(good + "2 0 -1e300 0 0 0 0 1\n").find(":2: the position is more than 1e7"),
      std::string::npos);
  EXPECT_NE(faultOfReading(good + "2 0 0 0 0 0 0 0\n").find(":2: the quaternion's norm is not 1"),
            std::string::npos);
  EXPECT_NE(faultOfReading("1 0 0 0 0 0 0 1 7\n").find(":1: more than eight"), std::string::npos);
  EXPECT_THROW(readTum("/nowhere/at_all.txt"), std::runtime_error);
  EXPECT_THROW(writeTum("/nowhere/at_all.txt", {}), std::runtime_error);
}

TEST(TumFile, KeepsRepeatedStampsOfOdometry) {
  const TemporaryFolder folder;
  const std::string path = folder.file("poses.txt");
  writeTumPoses(path, {pose(2, 1, 0), pose(2, 2, 0), pose(1, 3, 0)}, "profile\nseed");
  const auto poses = readTumPoses(path);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[1].stamp_ns, 2);
  EXPECT_EQ(poses[2].stamp_ns, 1);
  std::ifstream stream(path);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "# profile");
}

}  // namespace
}  // namespace ardrone_vslam
