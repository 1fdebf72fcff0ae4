// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace ardrone_vslam {

/// Seeded random numbers that are the same with every standard library: the standard fixes
/// mt19937_64 but not what its distributions do with it.
class RandomSource {
 public:
  /// @param stream  another stream gives independent numbers for the same seed
  explicit RandomSource(std::uint64_t seed, std::uint64_t stream = 0)
      : bits_(mix(mix(seed) + stream)) {}

  /// Spreads neighbouring numbers over all 64 bits (the finaliser of splitmix64).
  static std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// One of low .. high, both included. @pre low <= high
  int integer(int low, int high) {
    return low + static_cast<int>(uniform() * (static_cast<double>(high) - low + 1));
  }
  bool chance(double probability) { return uniform() < probability; }

  /// Mean 0, sigma 1 (Marsaglia's polar method).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double x = 0, y = 0, square = 0;
    do {
      x = uniform(-1, 1);
      y = uniform(-1, 1);
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double factor = std::sqrt(-2 * std::log(square) / square);
    spare_ = y * factor;
    has_spare_ = true;
    return x * factor;
  }
  /// Three independent numbers of sigma 1.
  Eigen::Vector3d normal3() {
    const double x = normal();
    const double y = normal();
    const double z = normal();
    return {x, y, z};
  }

 private:
  std::mt19937_64 bits_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace ardrone_vslam
