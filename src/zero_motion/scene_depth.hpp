// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "matching/track_order.hpp"
#include "odometry/image_rays.hpp"
#include "zero_motion/seen_motion.hpp"

namespace ardrone_vslam {

/// How far away the scene is, learned from how the image shifts beside the odometry's way: a
/// distribution over depths from 0.5 m to 900 m. Odometry drifts, so a way alone tells no depth: a
/// camera that hovers in a room and one that flies slowly through a hall may see the same. What
/// tells them apart is that a bias stays as it was while a flight changes. Each depth therefore has
/// a Kalman filter of the odometry's velocity bias, and the depths are weighed by how well each
/// explains what is seen and what is reported. One way: nothing here changes the estimate.
class SceneDepth {
 public:
  SceneDepth();

  /// The next image. Three times a second it is compared. O(features log features).
  /// @param T_odom_cam  by the odometry alone: what corrects the estimate is no motion
  void see(const ImageFeatures& features, const Eigen::Isometry3d& T_odom_cam);
  /// The depth that the scene is nearer than with this probability. O(depths).
  double quantile_m(double probability) const;

 private:
  /// What may be the scene's depth, and the odometry's bias if it were.
  struct Hypothesis {
    double depth_m = 0;
    double probability = 0;
    Eigen::Vector3d bias_m_s = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the bias
  };
  /// Between two images, axes of odom.
  struct Motion {
    double passed_s = 0;
    Eigen::Vector3d odometry_m = Eigen::Vector3d::Zero();
    SeenMotion seen;
  };
  /// The image that others are compared with.
  struct Reference {
    ImageRays rays;
    Eigen::Isometry3d T_odom_cam = Eigen::Isometry3d::Identity();
  };

  static double explain(const Motion& motion, Hypothesis& hypothesis);
  void judge(const Motion& motion);
  void spread(double passed_s, double rotation_rad);

  std::vector<Hypothesis> hypotheses_;  // from near to far
  Reference reference_, now_;
  TrackOrder order_;
  std::vector<BearingPair> pairs_;
};

}  // namespace ardrone_vslam
