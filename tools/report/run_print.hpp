// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>

namespace ardrone_vslam {

/// A table: a row for each seed, then median and worst. @param summary  of summaryOfSeeds
void printSeeds(const nlohmann::ordered_json& summary, std::ostream& out);

}  // namespace ardrone_vslam
