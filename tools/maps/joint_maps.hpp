// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "maps/map_alignment.hpp"

namespace ardrone_vslam {

/// Two maps in the first one's frame, with the errors of all their anchors and of where the second
/// lies, as what both see corrects them.
class JointMaps {
 public:
  JointMaps(const SavedMap& a, const SavedMap& b, const MapAlignment& alignment);

  /// An iterated update (Bell and Cathey 1993), as maps may differ in scale by a third; with
  /// weights, as some of the pairs are wrong. O((anchors of both)^3).
  void correctBy(const std::vector<LandmarkPair>& pairs);

  /// Whether the landmarks of a pair are one, now that the maps are corrected.
  bool areOne(const LandmarkPair& pair) const { return distance(pair) < kOne; }
  double apart_m(const LandmarkPair& pair) const { return offset(pair).norm(); }
  /// Of where b lies: position [m^2], heading [rad^2].
  Eigen::Vector4d moveVariances() const { return P_.diagonal().tail<kMove>(); }

  const SavedMap& a() const { return a_; }  ///< corrected
  const SavedMap& b() const { return b_; }  ///< corrected, in a's frame
  /// Of a's anchors, then of b's, with all their errors in a's frame.
  Eigen::MatrixXd anchorCovariance() const;

 private:
  static constexpr Eigen::Index kAnchor = SavedMap::kAnchor;
  static constexpr Eigen::Index kMove = 4;  // of where b lies in a: position, heading
  static constexpr double kOne = 16.3;      // of chi-square with three degrees of freedom, 99.9 %
  struct Sums {
    Eigen::MatrixXd information;  // H' W H
    Eigen::VectorXd vector;       // H' W r
  };

  Eigen::Index size() const { return of_a_ + of_b_ + kMove; }
  Eigen::Vector3d offset(const LandmarkPair& pair) const;
  Eigen::Matrix3d covarianceOf(const LandmarkPair& pair) const;
  double distance(const LandmarkPair& pair) const;
  Eigen::Matrix<double, 3, kMove> byMove(const Eigen::Vector3d& position) const;
  Eigen::Vector3d positionOf(const LandmarkPair& pair) const;
  Eigen::Matrix<double, 3, kAnchor> byTurnedAnchor(const MapAnchor& anchor,
                                                   const Eigen::Vector3d& position) const;
  Sums sumsOf(const std::vector<LandmarkPair>& pairs, bool are_weighted) const;
  SavedMap corrected(const SavedMap& before, const Eigen::VectorXd& errors,
                     const Eigen::Vector4d& move) const;

  SavedMap before_a_;
  SavedMap before_b_;
  SavedMap a_;
  SavedMap b_;
  Eigen::Index of_a_;
  Eigen::Index of_b_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  Eigen::Vector4d move_ = Eigen::Vector4d::Zero();  // of b, about the middle
  Eigen::MatrixXd P_;
};

}  // namespace ardrone_vslam
