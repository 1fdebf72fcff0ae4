// SPDX-License-Identifier: BSD-3-Clause
// How the camera is mounted, by how the images move when the odometry does.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "doctor/camera/doctor_seen_motion.hpp"

namespace ardrone_vslam {

enum class ExtrinsicsState {
  kTooLittleMotion,  ///< too few pairs of images that move
  kAmbiguous,        ///< other mountings explain the images nearly as well
  kNoAgreement,      ///< none does
  kFound
};

struct ExtrinsicsEstimate {
  ExtrinsicsState state = ExtrinsicsState::kTooLittleMotion;
  Eigen::Matrix3d R_base_cam = Eigen::Matrix3d::Identity();  ///< the best one
  double misfit_px = 0;                                      ///< of that
  double misfit_told_px = 0;                                 ///< of what tf says
  double misfit_rival_px = 0;  ///< of the next best that is another one
  double off_rad = 0;          ///< between the best one and what tf says
  double unsure_rad = 0;       ///< between what both halves of the motions say
  std::size_t motions = 0;

  /// At which the images fit the odometry best: an image is exposed at its stamp plus this. Rough;
  /// TimeOffsetEstimator tells it better once the mounting is known.
  double offset_s = 0;
  double misfit_unmoved_px = 0;  ///< with an offset of zero
};

/// Looks among the 24 turns of what tf says by quarter turns and offsets of up to 0.3 s, and finer
/// about the best of them.
ExtrinsicsEstimate estimateExtrinsics(const std::vector<ImagePair>& pairs,
                                      const OdometryWitness& odometry,
                                      const Eigen::Matrix3d& R_base_cam_told);

}  // namespace ardrone_vslam
