// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <vector>

namespace ardrone_vslam {

/// How a view turned about its axis and grew: what offsets in the image, column + i row, are
/// multiplied with. The argument is the turn from columns to rows, the magnitude the growth.
using ViewChange = std::complex<float>;
constexpr ViewChange kSameView{1, 0};

inline std::complex<float> complexOf(const Eigen::Vector2f& px) {
  return {px.x(), px.y()};
}
inline Eigen::Vector2f vectorOf(const std::complex<float>& px) {
  return {px.real(), px.imag()};
}

// Libraries differ in std::norm (a hypotenuse, or a sum of squares) and in how they divide.
inline float squareOf(const std::complex<float>& z) {
  return z.real() * z.real() + z.imag() * z.imag();
}
inline std::complex<float> quotientOf(const std::complex<float>& a, const std::complex<float>& b) {
  return a * std::conj(b) / squareOf(b);
}

/// How far `change` moves a pixel otherwise than `other`, as a share of its distance from the
/// middle.
inline float differenceOf(const ViewChange& change, const ViewChange& other) {
  return std::sqrt(squareOf(change - other) / squareOf(other));
}

/// Where a track was in one image, and where it is in the next: column + i row [px].
struct TrackMove {
  std::complex<float> before_px;
  std::complex<float> now_px;
};

/// What most tracks have in common, by least squares with weights (Geman and McClure 1985): wrong
/// matches and what moves by itself hardly count.
/// @return kSameView where fewer than 8 tracks tell the change, and where it is none that goes on
///   between two images (a difference of half)
ViewChange commonViewChange(const std::vector<TrackMove>& moves);

}  // namespace ardrone_vslam
