// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "config_files/config_path.hpp"

namespace ardrone_vslam {
namespace {

template <class Poses, class PositionOf>
bool standsStill(const Poses& poses, const PositionOf& positionOf) {
  constexpr double kRest_m = 1e-6;
  return std::all_of(poses.begin(), poses.end(), [&](const auto& pose) {
    return (positionOf(pose) - positionOf(poses.front())).norm() < kRest_m;
  });
}

void beginAtOrigin(RunOdometry& odometry) {
  if (odometry.run.states.empty()) return;
  const Eigen::Isometry3d first = odometry.run.states.front().T_odom_base;
  const Eigen::Vector3d forward = first.linear().col(0);
  const Eigen::AngleAxisd back(-std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ());
  const Eigen::Isometry3d T_new_old = back * Eigen::Translation3d(-first.translation());
  for (OdometryState& state : odometry.run.states)
    state.T_odom_base = T_new_old * state.T_odom_base;
}

}  // namespace

RunOdometry recordedOdometry(const Sequence& sequence) {
  const std::vector<OdometryState>& states = sequence.odometry();
  if (states.empty()) {
    throw std::runtime_error(
        sequence.name() +
        ": has no usable odometry at the images' stamps: the topic is missing, all of it was "
        "refused, "
        "or its clock is another one; record it with the images, or corrupt the truth by "
        "--odometry-profile");
  }
  const auto statePosition = [](const OdometryState& s) {
    return Eigen::Vector3d(s.T_odom_base.translation());
  };
  const auto truePosition = [](const StampedPose& p) {
    return Eigen::Vector3d(p.T_frame_body.translation());
  };
  if (states.size() > 1 && standsStill(states, statePosition) &&
      (sequence.truth().empty() || !standsStill(sequence.truth().poses(), truePosition))) {
    throw std::runtime_error(sequence.name() +
                             ": the odometry never moves, so no landmark can be made; check what "
                             "publishes it, or corrupt the "
                             "truth by --odometry-profile");
  }
  const OdometryNote note = sequence.odometryNote();
  return {note.profile.empty() ? "recorded" : note.profile, note.seed, {states, note.scale_error}};
}

RunOdometry simulatedOdometry(const Sequence& sequence, const std::string& profile,
                              std::uint64_t seed) {
  if (sequence.truth().empty()) {
    throw std::runtime_error(sequence.name() + ": has no true poses that the profile '" + profile +
                             "' could corrupt; add poses.txt or poses_tum.txt to a folder, or the "
                             "truth's topic to a bag");
  }
  return {profile, seed,
          simulateOdometry(sequence.truth(),
                           loadOdometryProfile(profile, findConfigFile("odometry_profiles.yaml")),
                           seed)};
}

std::vector<RunOdometry> simulatedOdometries(const Sequence& sequence, const std::string& profile,
                                             const std::vector<std::uint64_t>& seeds,
                                             bool is_at_zero) {
  std::vector<RunOdometry> odometries;
  for (const std::uint64_t seed : seeds) {
    odometries.push_back(simulatedOdometry(sequence, profile, seed));
    if (is_at_zero) beginAtOrigin(odometries.back());
  }
  return odometries;
}

Trajectory truthFromOdometryStart(const Trajectory& truth, const RunOdometry& odometry,
                                  bool& moved) {
  moved = false;
  if (truth.empty() || odometry.run.states.empty()) return truth;
  constexpr double kSamePlace_m = 0.1;
  constexpr double kSameAttitude_rad = 5 * M_PI / 180;
  const std::int64_t start_ns =
      std::max(truth.poses().front().stamp_ns, odometry.run.states.front().stamp_ns);
  const auto after =
      std::find_if(odometry.run.states.begin(), odometry.run.states.end(),
                   [start_ns](const OdometryState& s) { return s.stamp_ns >= start_ns; });
  if (after == odometry.run.states.end()) return truth;
  const Eigen::Isometry3d T_odom_map = after->T_odom_base * truth.at(after->stamp_ns).inverse();
  const Eigen::Vector3d offset_m =
      after->T_odom_base.translation() - truth.at(after->stamp_ns).translation();
  const double rotation_rad = Eigen::AngleAxisd(T_odom_map.linear()).angle();
  if (offset_m.norm() < kSamePlace_m && rotation_rad < kSameAttitude_rad) return truth;
  moved = true;
  std::vector<StampedPose> poses = truth.poses();
  for (StampedPose& pose : poses) pose.T_frame_body = T_odom_map * pose.T_frame_body;
  return Trajectory(std::move(poses));
}

}  // namespace ardrone_vslam
