// SPDX-License-Identifier: BSD-3-Clause
#include "linear/portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <limits>
#include <random>

namespace ardrone_vslam {
namespace {

constexpr int kTrials = 200'000;
constexpr double kUlp = 0x1p-52;  // of 1

/// The largest error, in units of what the last place of the true value is worth, at least of
/// `floor`.
double largestError_ulp(double from, double to, double floor,
                        const std::function<double(double)>& ours,
                        const std::function<long double(long double)>& exact) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> argument(from, to);
  double largest = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double x = argument(random);
    const long double want = exact(x);
    const double unit =
        std::exp2(std::floor(std::log2(std::max(std::abs(static_cast<double>(want)), floor)))) *
        kUlp;
    largest = std::max(largest, static_cast<double>(std::abs(ours(x) - want)) / unit);
  }
  return largest;
}

// Where a long double is a double (ARM), the library's own error comes on top: at most 1.
TEST(PortableMath, ErrsInTheLastPlaceAlone) {
  const auto sine = [](long double x) { return std::sin(x); };
  const auto cosine = [](long double x) { return std::cos(x); };
  for (const double range : {0.7, 4.0, 1e5}) {
    EXPECT_LT(largestError_ulp(-range, range, 0.5, portable::sin, sine), 4) << range;
    EXPECT_LT(largestError_ulp(-range, range, 0.5, portable::cos, cosine), 4) << range;
  }
  EXPECT_LT(largestError_ulp(-0.7, 0.7, 0, portable::sin, sine), 3);
  EXPECT_LT(
      largestError_ulp(-700, 700, 0, portable::exp, [](long double x) { return std::exp(x); }), 3);
  EXPECT_LT(
      largestError_ulp(1e-300, 3, 0, portable::log, [](long double x) { return std::log(x); }), 4);
  EXPECT_LT(
      largestError_ulp(-0.9, 3, 0, portable::log1p, [](long double x) { return std::log1p(x); }),
      6);
  for (const double x : {-1.7, -1e-5, 0.3, 2.0}) {
    EXPECT_LT(largestError_ulp(
                  -2, 2, 0, [x](double y) { return portable::atan2(y, x); },
                  [x](long double y) { return std::atan2(y, static_cast<long double>(x)); }),
              4)
        << x;
  }
}

TEST(PortableMath, KnowsTheEdges) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_EQ(portable::cos(0), 1);
  EXPECT_EQ(portable::exp(0), 1);
  EXPECT_EQ(portable::log(1), 0);
  EXPECT_EQ(portable::atan2(0, 0), 0);
  EXPECT_EQ(portable::atan2(0, -1), M_PI);
  EXPECT_EQ(portable::atan2(-1, 0), -M_PI_2);
  EXPECT_EQ(portable::exp(-1e4), 0);
  EXPECT_EQ(portable::exp(1e4), kInfinity);
  EXPECT_EQ(portable::log(0), -kInfinity);
  EXPECT_EQ(portable::log(kInfinity), kInfinity);
  for (const double none :
       {portable::sin(kNone), portable::cos(kInfinity), portable::atan2(kNone, 1),
        portable::atan2(1, kNone), portable::exp(kNone), portable::log(kNone), portable::log(-1),
        portable::log1p(kNone), portable::hypot(1, kNone)})
    EXPECT_TRUE(std::isnan(none));
}

// Of all results a sum, by Fowler, Noll and Vo. The same with GCC 12 and clang 14, with -O0 and
// -O3, on x86-64, ARMv7 and ARMv8.
TEST(PortableMath, HasTheSameBitsEverywhere) {
  std::uint64_t sum = 14695981039346656037U;
  const auto add = [&sum](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    sum = (sum ^ bits) * 1099511628211U;
  };
  for (int i = 1; i <= 100'000; ++i) {
    const double x = 1e-3 * i - 31.4;
    for (const double value :
         {portable::sin(x), portable::cos(x), portable::exp(x), portable::log(i / 7.0),
          portable::log1p(i * 1e-6), portable::atan2(x, i * 1e-4 - 3)})
      add(value);
  }
  EXPECT_EQ(sum, 10938408292318345040U);
}

}  // namespace
}  // namespace ardrone_vslam
