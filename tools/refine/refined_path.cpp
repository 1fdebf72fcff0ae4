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

}  // namespace

std::vector<Eigen::Isometry3d> refinedPath(const RunResult& run, const Refinement& refinement) {
  const auto& keyframes = run.record.keyframes;
  std::vector<Eigen::Isometry3d> path;
  path.reserve(run.frames.size());
  std::size_t next = 0;    // of the keyframes
  std::size_t begins = 0;  // the frame of the last one
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const RunFrame& frame = run.frames[i];
    const bool is_keyframe =
        next < keyframes.size() && keyframes[next].stamp_ns == frame.result.stamp_ns;
    if (path.empty() || (next == 0 && !is_keyframe)) {
      path.push_back(is_keyframe ? refinement.T_map_base[0] : frame.result.T_map_base);
    } else {
      path.push_back(path.back() * way(run.frames[i - 1], frame));
    }
    if (!is_keyframe) continue;
    const Eigen::Isometry3d& refined = refinement.T_map_base[next];
    if (next > 0) {
      const Eigen::Vector3d off_m = refined.translation() - path[i].translation();
      const Eigen::Vector3d turn =
          rotationVectorOf(refined.linear() * path[i].linear().transpose());
      const double span_ns =
          static_cast<double>(frame.result.stamp_ns - run.frames[begins].result.stamp_ns);
      for (std::size_t j = begins + 1; j <= i; ++j) {
        const double share = static_cast<double>(run.frames[j].result.stamp_ns -
                                                 run.frames[begins].result.stamp_ns) /
                             span_ns;
        path[j].translation() += share * off_m;
        path[j].linear() = rotationOf(share * turn) * path[j].linear();
      }
    } else {
      path[i] = refined;
    }
    begins = i;
    ++next;
  }
  return path;
}

}  // namespace ardrone_vslam
