// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_merge.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "ardrone_vslam/rotation.hpp"
#include "maps/map_parts.hpp"

namespace ardrone_vslam {
namespace {

constexpr Eigen::Index kAnchor = SavedMap::kAnchor;
constexpr Eigen::Index kMove = 4;  // of where b lies in a: position, heading

SavedMap moved(SavedMap map, const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  for (MapAnchor& anchor : map.anchors) anchor.T_map_rig = T * anchor.T_map_rig;
  const Eigen::Index size = map.anchor_covariance.rows();
  Eigen::MatrixXd J = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index at = 0; at < size; at += kAnchor) {
    J.block<3, 3>(at, at) = R;
    J.block<3, 3>(at + 3, at + 3) = R;
  }
  map.anchor_covariance = J * map.anchor_covariance * J.transpose();
  for (Landmark& landmark : map.landmarks) {
    landmark.position_map = T * landmark.position_map;
    landmark.view_direction_map = R * landmark.view_direction_map;
    landmark.covariance_m2 = R * landmark.covariance_m2 * R.transpose();
  }
  return map;
}

/// Both maps in a's frame, and the errors of their anchors with those of where b lies in a.
class Joint {
 public:
  Joint(const SavedMap& a, const SavedMap& b, const MapAlignment& alignment)
      : before_a_(a),
        before_b_(moved(b, alignment.T_a_b)),
        a_(before_a_),
        b_(before_b_),
        of_a_(a.anchor_covariance.rows()),
        of_b_(b.anchor_covariance.rows()),
        P_(Eigen::MatrixXd::Zero(size(), size())) {
    for (const LandmarkPair& pair : alignment.agreed)
      middle_ += a.landmarks[pair.of_a].position_map / static_cast<double>(alignment.agreed.size());
    P_.topLeftCorner(of_a_, of_a_) = a_.anchor_covariance;
    P_.block(of_a_, of_a_, of_b_, of_b_) = b_.anchor_covariance;
    // Nothing is known of the move but what the pairs tell: wide beside what the maps may err.
    const double drift_m2 = std::max(most(a_), most(b_));
    P_.bottomRightCorner<kMove, kMove>().diagonal()
        << Eigen::Vector3d::Constant(1 + 100 * drift_m2),
        1;
  }

  /// An iterated update (Bell and Cathey 1993), as maps may differ in scale by a third; with
  /// weights, as some of the pairs are wrong.
  void correctBy(const std::vector<LandmarkPair>& pairs) {
    constexpr int kSteps = 8;
    const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(size(), size());
    Eigen::VectorXd errors = Eigen::VectorXd::Zero(size());
    Eigen::MatrixXd gain;
    Sums sums;
    for (int step = 0; step < kSteps; ++step) {
      sums = sumsOf(pairs, step > 0);
      // (P^-1 + information)^-1 of a P that may be singular: a map's first anchor errs by nothing.
      gain = (I + P_ * sums.information).partialPivLu().solve(P_);
      errors = gain * (sums.vector + sums.information * errors);
      a_ = corrected(before_a_, errors.head(of_a_), Eigen::Vector4d::Zero());
      b_ = corrected(before_b_, errors.segment(of_a_, of_b_), errors.tail<kMove>());
    }
    const Eigen::MatrixXd rest = I - gain * sums.information;
    // In this form (Joseph's) it stays positive.
    P_ = rest * P_ * rest.transpose() + gain * sums.information * gain.transpose();
  }

  /// Whether the landmarks of a pair are one, now that the maps are corrected.
  bool areOne(const LandmarkPair& pair) const { return distance(pair) < kOne; }
  double apart_m(const LandmarkPair& pair) const { return offset(pair).norm(); }
  Eigen::Vector4d moveVariances() const { return P_.diagonal().tail<kMove>(); }

  const SavedMap& a() const { return a_; }
  const SavedMap& b() const { return b_; }

  /// All errors of both maps' anchors in a's frame: their own, and by the move.
  Eigen::MatrixXd anchorCovariance() const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(of_a_ + of_b_, size());
    M.leftCols(of_a_ + of_b_).setIdentity();
    for (std::size_t i = 0; i < b_.anchors.size(); ++i) {
      const Eigen::Index at = of_a_ + coordinateOf(i);
      M.block<3, kMove>(at, of_a_ + of_b_) = byMove(b_.anchors[i].T_map_rig.translation());
      M(at + 5, size() - 1) = 1;
    }
    const Eigen::MatrixXd P = M * P_ * M.transpose();
    return 0.5 * (P + P.transpose());
  }

 private:
  static constexpr double kOne = 16.3;  // of chi-square with three degrees of freedom, 99.9 %
  struct Sums {
    Eigen::MatrixXd information;  // H' W H
    Eigen::VectorXd vector;       // H' W r
  };

  static double most(const SavedMap& map) {
    double most_m2 = 0;
    for (Eigen::Index at = 0; at < map.anchor_covariance.rows(); at += kAnchor)
      most_m2 = std::max(most_m2, map.anchor_covariance.diagonal().segment<3>(at).maxCoeff());
    return most_m2;
  }

  Eigen::Index size() const { return of_a_ + of_b_ + kMove; }

  Eigen::Vector3d offset(const LandmarkPair& pair) const {
    return a_.landmarks[pair.of_a].position_map - b_.landmarks[pair.of_b].position_map;
  }
  /// Of an offset that anchors and move do not explain.
  Eigen::Matrix3d covarianceOf(const LandmarkPair& pair) const {
    return a_.landmarks[pair.of_a].covariance_m2 + b_.landmarks[pair.of_b].covariance_m2 +
           kOtherView_m * kOtherView_m * Eigen::Matrix3d::Identity();
  }
  double distance(const LandmarkPair& pair) const {
    return offset(pair).dot(covarianceOf(pair).inverse() * offset(pair));
  }

  Eigen::Matrix<double, 3, kMove> byMove(const Eigen::Vector3d& position) const {
    Eigen::Matrix<double, 3, kMove> J;
    J << Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitZ().cross(position - middle_);
    return J;
  }

  Sums sumsOf(const std::vector<LandmarkPair>& pairs, bool are_weighted) const {
    constexpr Eigen::Index kOfPair = 2 * kAnchor + kMove;
    Sums sums{Eigen::MatrixXd::Zero(size(), size()), Eigen::VectorXd::Zero(size())};
    for (const LandmarkPair& pair : pairs) {
      const Landmark& in_a = a_.landmarks[pair.of_a];
      const Landmark& in_b = b_.landmarks[pair.of_b];
      Eigen::Matrix<double, 3, kOfPair> H;
      H << -byAnchor(a_.anchors[in_a.anchor_id - 1], in_a.position_map),
          byAnchor(b_.anchors[in_b.anchor_id - 1], in_b.position_map), byMove(in_b.position_map);
      const double weight = are_weighted ? 1 / (1 + distance(pair) / kOne) : 1;  // Cauchy's
      const Eigen::Matrix<double, kOfPair, 3> HtW =
          weight * H.transpose() * covarianceOf(pair).inverse();
      const Eigen::Matrix<double, kOfPair, kOfPair> HtWH = HtW * H;
      const Eigen::Matrix<double, kOfPair, 1> HtWr = HtW * offset(pair);
      const std::array<std::array<Eigen::Index, 3>, 3> parts = {
          {{coordinateOf(in_a.anchor_id - 1), 0, kAnchor},
           {of_a_ + coordinateOf(in_b.anchor_id - 1), kAnchor, kAnchor},
           {of_a_ + of_b_, 2 * kAnchor, kMove}}};
      for (const auto& [to, from, rows] : parts) {
        sums.vector.segment(to, rows) += HtWr.segment(from, rows);
        for (const auto& [to_col, from_col, cols] : parts)
          sums.information.block(to, to_col, rows, cols) += HtWH.block(from, from_col, rows, cols);
      }
    }
    return sums;
  }

  /// @param before  the map; @param errors  of its anchors; @param move  of all of it
  SavedMap corrected(const SavedMap& before, const Eigen::VectorXd& errors,
                     const Eigen::Vector4d& move) const {
    SavedMap map = before;
    const Eigen::Matrix3d turn = rotationAboutZ(move(3));
    const auto goesTo = [&](const Eigen::Vector3d& position) -> Eigen::Vector3d {
      return middle_ + turn * (position - middle_) + move.head<3>();
    };
    const auto turnOf = [&](std::size_t anchor) -> Eigen::Matrix3d {
      return turn * rotationOf(errors.segment<3>(coordinateOf(anchor) + 3));
    };
    for (Landmark& landmark : map.landmarks) {
      const std::size_t anchor = landmark.anchor_id - 1;
      landmark.position_map =
          goesTo(landmark.position_map + byAnchor(map.anchors[anchor], landmark.position_map) *
                                             errors.segment<kAnchor>(coordinateOf(anchor)));
      landmark.view_direction_map = turnOf(anchor) * landmark.view_direction_map;
    }
    for (std::size_t i = 0; i < map.anchors.size(); ++i) {
      Eigen::Isometry3d& T = map.anchors[i].T_map_rig;
      T.translation() = goesTo(T.translation() + errors.segment<3>(coordinateOf(i)));
      T.linear() = turnOf(i) * T.linear();
    }
    return map;
  }

  SavedMap before_a_;
  SavedMap before_b_;
  SavedMap a_;
  SavedMap b_;
  Eigen::Index of_a_;
  Eigen::Index of_b_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  Eigen::MatrixXd P_;
};

/// All landmarks of both, of each pair that which was seen more often.
SavedMap together(const Joint& joint, const std::vector<LandmarkPair>& pairs) {
  SavedMap map = joint.a();
  const SavedMap& b = joint.b();
  const auto first_of_b = static_cast<std::uint32_t>(map.anchors.size());
  map.stamp_ns = std::max(map.stamp_ns, b.stamp_ns);
  map.anchors.insert(map.anchors.end(), b.anchors.begin(), b.anchors.end());
  map.anchor_covariance = joint.anchorCovariance();
  std::vector<Landmark> of_b = b.landmarks;
  for (Landmark& landmark : of_b) landmark.anchor_id += first_of_b;
  std::vector<bool> is_gone(of_b.size(), false);
  for (const LandmarkPair& pair : pairs) {
    Landmark& kept = map.landmarks[pair.of_a];
    const Landmark& other = of_b[pair.of_b];
    is_gone[pair.of_b] = true;
    const int times_seen = kept.times_seen + other.times_seen;
    if (other.times_seen > kept.times_seen) kept = other;
    kept.times_seen = times_seen;
  }
  for (std::size_t i = 0; i < of_b.size(); ++i) {
    if (!is_gone[i]) map.landmarks.push_back(of_b[i]);
  }
  std::vector<std::size_t> oldest_first(map.anchors.size());
  std::iota(oldest_first.begin(), oldest_first.end(), 0);
  std::stable_sort(oldest_first.begin(), oldest_first.end(), [&map](std::size_t i, std::size_t j) {
    return map.anchors[i].stamp_ns < map.anchors[j].stamp_ns;
  });
  map = withAnchors(map, oldest_first);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i)
    map.landmarks[i].id = static_cast<std::uint32_t>(i + 1);
  return map;
}

}  // namespace

MergedMap merge(const SavedMap& a, const SavedMap& b, const MapAlignment& alignment) {
  const std::string difference = cameraDifference(a.camera, b.camera);
  if (!difference.empty()) throw MapFileError("the maps are of two cameras: " + difference);
  Joint joint(a, b, alignment);
  joint.correctBy(alignment.agreed);
  MergedMap merged;
  std::vector<LandmarkPair> shared;
  std::vector<double> apart_m;
  for (const LandmarkPair& pair : alignment.agreed) {
    apart_m.push_back(joint.apart_m(pair));
    if (joint.areOne(pair)) shared.push_back(pair);
  }
  const auto middle = apart_m.begin() + static_cast<std::ptrdiff_t>(apart_m.size() / 2);
  std::nth_element(apart_m.begin(), middle, apart_m.end());
  merged.map = together(joint, shared);
  merged.shared = shared.size();
  merged.apart_m = *middle;
  const Eigen::Vector4d variances = joint.moveVariances();
  merged.sigma_m = std::sqrt(variances.head<3>().sum() / 3);
  merged.sigma_rad = std::sqrt(variances(3));
  return merged;
}

}  // namespace ardrone_vslam
