// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace ardrone_vslam {

/// Median and worst over the summaries of several seeds, for every numeric entry where larger is
/// worse. @param summaries  of summaryOf, at least one
nlohmann::ordered_json summaryOfSeeds(const std::vector<nlohmann::ordered_json>& summaries);

}  // namespace ardrone_vslam
