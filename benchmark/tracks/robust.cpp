// SPDX-License-Identifier: BSD-3-Clause
#include "robust.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardrone_vslam::bench {

double medianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double sigmaOf(std::vector<double> values) {
  constexpr double kSigmaPerMedian = 1.4826;  // of a normal distribution
  for (double& value : values) value = std::abs(value);
  return kSigmaPerMedian * medianOf(std::move(values));
}

}  // namespace ardrone_vslam::bench
