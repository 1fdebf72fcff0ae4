// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "ardrone_vslam/slam_config.hpp"

namespace ardrone_vslam {

/// Parameters that contradict each other, and what helps: a sentence each.
std::vector<std::string> faultsBetween(const SlamConfig& config);

}  // namespace ardrone_vslam
