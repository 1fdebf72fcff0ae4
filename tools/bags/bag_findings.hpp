// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// What was dropped of a bag and what looks wrong in it, a sentence each, naming the topic.
struct BagFindings {
  std::vector<std::string> warnings;
  /// Among them: so much was dropped that what is left is not what was recorded.
  bool has_lost_much = false;

  void warn(const std::string& topic, const std::string& fault) {
    warnings.push_back(topic + ": " + fault);
  }
  /// `dropped` of `total` messages. @param what  "messages dropped: ..." and what helps
  void lose(std::size_t dropped, std::size_t total, const std::string& topic,
            const std::string& what) {
    if (dropped == 0) return;
    warn(topic, std::to_string(dropped) + " " + what);
    if (static_cast<double>(dropped) > kMuchLost * static_cast<double>(total)) has_lost_much = true;
  }
  void append(const BagFindings& others) {
    warnings.insert(warnings.end(), others.warnings.begin(), others.warnings.end());
    has_lost_much = has_lost_much || others.has_lost_much;
  }
};

}  // namespace ardrone_vslam
