// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/setup_watch.hpp"
#include "setup/compared_motion.hpp"

namespace ardrone_vslam {

/// Which set-up explains the motions that were seen: the one that is told, or one with a fault.
class SetupHypotheses {
 public:
  SetupHypotheses(const Eigen::Isometry3d& T_base_cam, double image_time_offset_s);

  void add(const ComparedMotion& motion);
  const SetupFinding& finding() const { return finding_; }
  /// Whether what is told fits so badly that wrong focal lengths should be looked at, too.
  bool wantsFactors() const;

 private:
  struct Hypothesis {
    SetupFault fault = SetupFault::kNone;
    std::size_t which = 0;  // of the offsets, or of the factors
    /// Turns, or mirrors, what is told: columns are the true camera's axes in the told one.
    Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();
    double squares = 0;
  };
  static double squaresOf(const Hypothesis& hypothesis, const ComparedMotion& motion);
  void judge();
  void saturate();
  bool isConfirmed(double told) const;
  void forget();
  const Hypothesis& bestWith(bool fault) const;
  void name(const Hypothesis& best);

  Eigen::Isometry3d T_base_cam_;
  double image_time_offset_s_;
  std::vector<Hypothesis> hypotheses_;
  double motions_ = 0;  // so many are in the sums
  SetupFinding finding_;
};

}  // namespace ardrone_vslam
