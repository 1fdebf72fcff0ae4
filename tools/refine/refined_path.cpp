// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_path.hpp"

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

/// From one frame to another, as best known without the keyframes about them.
Eigen::Isometry3d way(const RunFrame& from, const RunFrame& to) {
  // The filter holds a camera that rests, and takes jumps out of the odometry.
  const bool is_fused = to.result.state == SlamState::kResting || to.result.odometry_step_m > 0;
  const auto pose = [is_fused](const RunFrame& frame) {
    return is_fused ? frame.result.T_map_base : frame.result.T_odom_base;
  };
  return pose(from).inverse() * pose(to);
}

/// Moves the poses after frame `from` so that the one of `to` is the refined one, those between by
/// their share of the time.
void spread(const RunResult& run, std::size_t from, std::size_t to,
            const Eigen::Isometry3d& refined, std::vector<Eigen::Isometry3d>& path) {
  const Eigen::Vector3d off_m = refined.translation() - path[to].translation();
  const Eigen::Vector3d turn = rotationVectorOf(refined.linear() * path[to].linear().transpose());
  const auto passed_ns = [&](std::size_t frame) {
    return static_cast<double>(run.frames[frame].result.stamp_ns -
                               run.frames[from].result.stamp_ns);
  };
  for (std::size_t i = from + 1; i <= to; ++i) {
    const double share = passed_ns(i) / passed_ns(to);
    path[i].translation() += share * off_m;
    path[i].linear() = rotationOf(share * turn) * path[i].linear();
  }
}

}  // namespace

std::vector<Eigen::Isometry3d> refinedPath(const RunResult& run, const Refinement& refinement) {
  const auto& keyframes = run.record.keyframes;
  std::vector<Eigen::Isometry3d> path;
  path.reserve(run.frames.size());
  std::size_t next = 0;  // of the keyframes
  std::size_t last = 0;  // the frame of the one before
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const RunFrame& frame = run.frames[i];
    const bool has_begun = next > 0;
    path.push_back(has_begun ? path.back() * way(run.frames[i - 1], frame)
                             : frame.result.T_map_base);
    if (next == keyframes.size() || keyframes[next].stamp_ns != frame.result.stamp_ns) continue;
    const Eigen::Isometry3d& refined = refinement.T_map_base[next++];
    if (has_begun) spread(run, last, i, refined, path);
    path[i] = refined;
    last = i;
  }
  return path;
}

}  // namespace ardrone_vslam
