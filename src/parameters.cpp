// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/parameters.hpp"

#include <sstream>

namespace ardrone_vslam {
namespace {

std::string joined(const std::vector<std::string>& faults) {
  std::string text = "invalid configuration:";
  for (const auto& fault : faults) text += "\n  - " + fault;
  return text;
}

}  // namespace

ConfigError::ConfigError(const std::vector<std::string>& faults)
    : std::runtime_error(joined(faults)), faults_(faults) {}

void detail::RangeCheck::check(const ParameterInfo& info, double value) const {
  if (value >= info.min && value <= info.max) return;  // false for NaN, as it must be
  std::ostringstream fault;
  fault << info.name << " is " << value << " but must be between " << info.min << " and "
        << info.max << " [" << info.unit << "]";
  faults->push_back(fault.str());
}

}  // namespace ardrone_vslam
