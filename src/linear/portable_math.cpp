// SPDX-License-Identifier: BSD-3-Clause
#include "linear/portable_math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ardrone_vslam::portable {
namespace {

// All by Taylor series about 0, to which periods, powers of two and symmetries bring the argument;
// as long as the first term left out is below 2^-55 of the sum.

/// c_0 + c_1 x + c_2 x^2 + ...
template <std::size_t kTerms>
double sum(const std::array<double, kTerms>& c, double x) {
  double value = c[kTerms - 1];
  for (std::size_t i = kTerms - 1; i-- > 0;) value = value * x + c[i];
  return value;
}

/// 1/first!, sign/(first + step)!, 1/(first + 2 step)! ...
template <std::size_t kTerms>
constexpr std::array<double, kTerms> inverseFactorials(int first, int step, double sign) {
  std::array<double, kTerms> c{};
  double factorial = 1;  // exact to 18!
  int n = 1;
  double of_term = 1;
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (; n <= first + step * static_cast<int>(i); ++n) factorial *= n;
    c[i] = of_term / factorial;
    of_term *= sign;
  }
  return c;
}

/// 1, sign/3, 1/5, sign/7 ...
template <std::size_t kTerms>
constexpr std::array<double, kTerms> inverseOdd(double sign) {
  std::array<double, kTerms> c{};
  double of_term = 1;
  for (std::size_t i = 0; i < kTerms; ++i) {
    c[i] = of_term / static_cast<double>(2 * i + 1);
    of_term *= sign;
  }
  return c;
}

constexpr auto kSine = inverseFactorials<9>(1, 2, -1);    // to x^17
constexpr auto kCosine = inverseFactorials<9>(0, 2, -1);  // to x^16
constexpr auto kExponential = inverseFactorials<15>(0, 1, 1);
constexpr auto kArcTangent = inverseOdd<9>(-1);
constexpr auto kLogarithm = inverseOdd<12>(1);

// Constants in parts: the first ones have so few bits that their products with whole numbers below
// 2^20 are exact.
constexpr double kHalfPi_1 = 0x1.921fb544p0, kHalfPi_2 = 0x1.0b4611a6p-34,
                 kHalfPi_3 = 0x1.3198a2e037073p-69;
constexpr double kLog2_1 = 0x1.62e42feep-1, kLog2_2 = 0x1.a39ef35793c76p-33;
constexpr double kLargest_rad = 1e5;
constexpr double kLargestExponent = 709.78, kSmallestExponent = -745.2;

/// An angle as quarter turns and the rest, of at most an eighth turn.
struct Reduced {
  double quarter;  // 0, 1, 2 or 3
  double rest_rad;
  double rest_2;
};

Reduced reduce(double angle_rad) {
  if (std::abs(angle_rad) > kLargest_rad) angle_rad = std::remainder(angle_rad, 2 * M_PI);
  const double turns = std::nearbyint(angle_rad * M_2_PI);
  const double rest_rad = ((angle_rad - turns * kHalfPi_1) - turns * kHalfPi_2) - turns * kHalfPi_3;
  return {turns - 4 * std::floor(turns / 4), rest_rad, rest_rad * rest_rad};
}

double sineOf(const Reduced& angle) {
  return angle.rest_rad * sum(kSine, angle.rest_2);
}

double cosineOf(const Reduced& angle) {
  return sum(kCosine, angle.rest_2);
}

/// 2 artanh(s) = log((1 + s) / (1 - s))
double logarithmBy(double s) {
  return 2 * s * sum(kLogarithm, s * s);
}

}  // namespace

double sin(double angle_rad) {
  const Reduced angle = reduce(angle_rad);
  if (angle.quarter == 1) return cosineOf(angle);
  if (angle.quarter == 2) return -sineOf(angle);
  if (angle.quarter == 3) return -cosineOf(angle);
  return sineOf(angle);
}

double cos(double angle_rad) {
  const Reduced angle = reduce(angle_rad);
  if (angle.quarter == 1) return -sineOf(angle);
  if (angle.quarter == 2) return -cosineOf(angle);
  if (angle.quarter == 3) return sineOf(angle);
  return cosineOf(angle);
}

double tan(double angle_rad) {
  return sin(angle_rad) / cos(angle_rad);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double larger = std::max(std::abs(x), std::abs(y));
  const double smaller = std::min(std::abs(x), std::abs(y));
  if (larger == 0) return 0;
  const double tangent = smaller / larger;
  // The nearest sixteenth of a half turn is taken off: tan(a - b) = (tan a - tan b) / (1 + tan a
  // tan b).
  constexpr std::array<double, 5> kTangents = {0, 0x1.975f5e0553158p-3, 0x1.a827999fcef32p-2,
                                               0x1.561b82ab7f990p-1, 1};
  constexpr std::array<double, 4> kBetween = {0.0985, 0.3033, 0.5345, 0.8207};
  std::size_t i = 0;
  while (i < kBetween.size() && tangent > kBetween[i]) ++i;
  const double rest = (tangent - kTangents[i]) / (1 + tangent * kTangents[i]);
  double angle_rad = static_cast<double>(i) * (M_PI / 16) + rest * sum(kArcTangent, rest * rest);
  if (std::abs(y) > std::abs(x)) angle_rad = M_PI_2 - angle_rad;
  if (x < 0) angle_rad = M_PI - angle_rad;
  return std::copysign(angle_rad, y);
}

double exp(double x) {
  if (x < kSmallestExponent) return 0;
  if (x > kLargestExponent) return std::numeric_limits<double>::infinity();
  if (std::isnan(x)) return x;
  const double power = std::nearbyint(x * M_LOG2E);
  const double rest = (x - power * kLog2_1) - power * kLog2_2;
  return std::ldexp(sum(kExponential, rest), static_cast<int>(power));
}

double log(double x) {
  if (x == 0) return -std::numeric_limits<double>::infinity();
  if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(x)) return x;
  int power = 0;
  double mantissa = std::frexp(x, &power);  // from 0.5 to 1
  if (mantissa < M_SQRT1_2) {
    mantissa *= 2;
    --power;
  }
  return power * kLog2_1 + (power * kLog2_2 + logarithmBy((mantissa - 1) / (mantissa + 1)));
}

double log1p(double x) {
  return std::abs(x) < 0.25 ? logarithmBy(x / (2 + x)) : log(1 + x);
}

double hypot(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace ardrone_vslam::portable
