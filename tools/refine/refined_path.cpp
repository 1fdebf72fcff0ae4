// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_path.hpp"

#include "ardrone_vslam/rotation.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {
namespace {

/// From one frame to another, as best known without the keyframes about them.
Eigen::Isometry3d way(const RunFrame& from, const RunFrame& to) {
  // The filter holds a camera that rests, and takes jumps out of the odometry. As a rest begins, it
  // may correct the pose.
  const bool rests =
      from.result.state == SlamState::kResting && to.result.state == SlamState::kResting;
  const bool is_fused = rests || to.result.odometry_step_m > 0;
  const auto pose = [is_fused](const RunFrame& frame) {
    return is_fused ? frame.result.T_map_base : frame.result.T_odom_base;
  };
  return pose(from).inverse() * pose(to);
}

/// Moves the poses after number `from` so that the last is the refined one, those between by their
/// share of the time.
void spread(const Eigen::Isometry3d& refined, std::size_t from, std::vector<StampedPose>& path) {
  const StampedPose last = path.back();
  const Eigen::Vector3d off_m = refined.translation() - last.T_frame_body.translation();
  const Eigen::Vector3d turn =
      rotationVectorOf(refined.linear() * last.T_frame_body.linear().transpose());
  const auto passed_ns = [&](const StampedPose& pose) {
    return static_cast<double>(pose.stamp_ns - path[from].stamp_ns);
  };
  for (std::size_t i = from + 1; i < path.size(); ++i) {
    const double share = passed_ns(path[i]) / passed_ns(last);
    Eigen::Isometry3d& T = path[i].T_frame_body;
    T.translation() += share * off_m;
    T.linear() = rotationOf(share * turn) * T.linear();
  }
}

}  // namespace

std::vector<Eigen::Isometry3d> refinedPath(const RunResult& run, const Refinement& refinement) {
  const auto& keyframes = run.record.keyframes;
  std::vector<StampedPose> path;
  path.reserve(run.frames.size());
  std::size_t next = 0;  // of the keyframes
  std::size_t last = 0;  // the frame of the one before
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const RunFrame& frame = run.frames[i];
    const std::int64_t stamp_ns = frame.result.stamp_ns;
    const bool has_begun = next > 0;
    path.push_back({stamp_ns, has_begun ? path.back().T_frame_body * way(run.frames[i - 1], frame)
                                        : frame.result.T_map_base});
    if (next == keyframes.size() || keyframes[next].stamp_ns != stamp_ns) continue;
    const Eigen::Isometry3d& refined = refinement.T_map_base[next++];
    if (has_begun) spread(refined, last, path);
    path.back().T_frame_body = refined;
    last = i;
  }
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(path.size());
  for (const StampedPose& pose : path) poses.push_back(pose.T_frame_body);
  return poses;
}

PosesByStamp refinedPoses(const FlightRecord& record, const Refinement& refinement) {
  PosesByStamp poses;
  const std::vector<Eigen::Isometry3d>& refined = refinement.T_map_base;
  for (std::size_t k = 0; k < refined.size(); ++k) {
    const Keyframe& keyframe = record.keyframes[k];
    poses[keyframe.stamp_ns] = refined[k] * Eigen::Isometry3d(refinement.R_base_rig[k]);
    if (k == 0) continue;
    // Another camera begins with a keyframe.
    const Eigen::Isometry3d T_base_rig(refinement.R_base_rig[k - 1]);
    const Keyframe& before = record.keyframes[k - 1];
    const Eigen::Isometry3d T_map_odom = refined[k - 1] * before.T_odom_base.inverse();
    std::vector<StampedPose> leg{{before.stamp_ns, refined[k - 1]}};
    for (const PassedFrame& frame : keyframe.passed)
      leg.push_back({frame.stamp_ns, T_map_odom * frame.T_odom_base});
    leg.push_back({keyframe.stamp_ns, T_map_odom * keyframe.T_odom_base});
    spread(refined[k], 0, leg);
    for (std::size_t i = 1; i + 1 < leg.size(); ++i)
      poses[leg[i].stamp_ns] = leg[i].T_frame_body * T_base_rig;
  }
  return poses;
}

}  // namespace ardrone_vslam
