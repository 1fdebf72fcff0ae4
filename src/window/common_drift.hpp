// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ardrone_vslam {

class WindowState;

/// P(:, of) * B of a window's covariance P, in single precision. The motion that all poses share, a
/// drift of many metres, drops out of most measurements, but not from what single precision rounds.
/// So it is taken apart: with C the columns of the newest pose and S picking a pose's coordinates,
/// P B = (P - C S) B + C (S B), and S B is next to nothing. O(size * coordinates * measurements).
/// @param of  the coordinates that are measured
/// @param B  a row for each of them, a column for each measurement
Eigen::MatrixXf covarianceTimes(const WindowState& state, const std::vector<int>& of,
                                const Eigen::MatrixXd& B);
/// The rows P(of, of) * B alone.
Eigen::MatrixXf ownCovarianceTimes(const WindowState& state, const std::vector<int>& of,
                                   const Eigen::MatrixXd& B);

}  // namespace ardrone_vslam
