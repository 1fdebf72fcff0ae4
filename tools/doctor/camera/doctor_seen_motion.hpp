// SPDX-License-Identifier: BSD-3-Clause
// How the images move, beside how the odometry does.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// Two images of a camera about a quarter of a second apart, and the tracks that both have.
struct ImagePair {
  std::int64_t before_ns = 0;
  std::int64_t now_ns = 0;
  double focal_length_px = 0;
  struct Track {
    Eigen::Vector3d before;  ///< bearings
    Eigen::Vector3d now;
  };
  std::vector<Track> tracks;
};

/// Those in which the tracks move enough to tell anything.
std::vector<ImagePair> movingPairs(const std::vector<ImageFeatures>& images);

/// A pair of images, and how base moved between them by the odometry.
struct SeenMotion {
  const ImagePair* images = nullptr;
  Eigen::Matrix3d R_before_now = Eigen::Matrix3d::Identity();       ///< of base
  Eigen::Vector3d displacement_before_m = Eigen::Vector3d::Zero();  ///< of the camera, axes of base
};

/// The odometry that the images are compared with.
struct OdometryWitness {
  const std::vector<OdometryState>& states;  ///< stamps ascending
  Eigen::Vector3d lever_base_m;              ///< the camera's place on base

  /// Of the pairs around which there is odometry; they must outlive the answer.
  /// @param offset_s  an image is exposed at its stamp plus this
  std::vector<SeenMotion> motions(const std::vector<ImagePair>& pairs, double offset_s) const;
};

/// How far the tracks are from where the odometry would have taken them, at any depth beyond 0.3 m:
/// mean over the motions of the mean over the tracks, each cut at `cut_px`.
double misfit_px(const std::vector<SeenMotion>& motions, const Eigen::Matrix3d& R_base_cam,
                 double cut_px);

}  // namespace ardrone_vslam
