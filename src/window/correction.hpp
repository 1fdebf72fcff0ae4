// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ardrone_vslam {

struct Information;
class WindowState;

/// What an information does to a window: its coordinates change by `error`, and its covariance P
/// becomes P - G G', G being the gain. In single precision, or in doubles where a correction takes
/// so much of a variance that rounding would be felt.
class Correction {
 public:
  /// Nothing when it is not positive or not finite. With the information's rows B (H' W H = B B',
  /// H' W r = B m) the gain is P B (I + B' P B)^-1, and only so many columns as there are
  /// independent measurements take part. O(coordinates^2 * measurements).
  static std::optional<Correction> by(const Information& information, const WindowState& state);

  /// Of all coordinates; empty if nothing was measured.
  const Eigen::VectorXd& error() const { return error_; }
  /// G times the transpose of four of its rows.
  Eigen::MatrixX4d gainTimesRows(int first) const;
  /// P -= G G' + T V' + V T', and what may have been rounded off is added.
  void subtractFrom(Eigen::Block<Eigen::MatrixXd> P, const Eigen::MatrixX4d& T,
                    const Eigen::MatrixX4d& V) const;

 private:
  Eigen::MatrixXf single_;   // the gain
  Eigen::MatrixXd doubles_;  // the same in doubles; empty if single precision is enough
  Eigen::VectorXd error_;
};

}  // namespace ardrone_vslam
