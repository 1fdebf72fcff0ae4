// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ardrone_vslam {

/// One sentence, or a few: whether the fused pose was better than the odometry; if not, why, and
/// what helps. @param summary  of summaryOf, here and below
std::string verdictOf(const nlohmann::ordered_json& summary);

/// Six lines for a person: images, odometry, fused pose, covariance, states, cost.
std::string inLines(const nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
