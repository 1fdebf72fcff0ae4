// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/parameters.hpp"

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>

namespace ardrone_vslam {
namespace {

std::string joined(const std::vector<std::string>& faults) {
  std::string text = "invalid configuration:";
  for (const auto& fault : faults) text += "\n  - " + fault;
  return text;
}

/// Number of letters to insert, remove or replace to make one word of the other (Levenshtein).
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// As the edit distance, but a piece of a name counts as one slip.
std::size_t slipsBetween(const std::string& written, const std::string& name) {
  constexpr std::size_t kWordLength = 4;  // shorter pieces are part of too many names
  const bool is_piece = written.size() >= kWordLength && (name.find(written) != std::string::npos ||
                                                          written.find(name) != std::string::npos);
  return is_piece ? 1 : editDistance(written, name);
}

}  // namespace

std::string nearestName(const std::string& written, const std::set<std::string>& known) {
  std::string nearest;
  std::size_t fewest = written.size() / 2 + 1;  // more than half of it wrong is not similar
  for (const std::string& name : known) {
    const std::size_t slips = slipsBetween(written, name);
    if (slips >= fewest) continue;
    fewest = slips;
    nearest = name;
  }
  return nearest;
}

ConfigError::ConfigError(const std::vector<std::string>& faults)
    : std::runtime_error(joined(faults)), faults_(faults) {}

void detail::RangeCheck::check(const ParameterInfo& info, double value) const {
  if (value >= info.min && value <= info.max) return;  // false for NaN, as it must be
  std::ostringstream fault;
  fault << std::setprecision(10) << info.name << " is " << value << " but must be between "
        << info.min << " and " << info.max << " [" << info.unit << "]";
  faults->push_back(fault.str());
}

}  // namespace ardrone_vslam
