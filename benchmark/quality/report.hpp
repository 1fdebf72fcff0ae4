// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "chart.hpp"

namespace ardrone_vslam::quality {

/// All curves as JSON, for plot.py.
std::string toJson(const QualityResults& results);

/// The part of the page: what was measured, how, and compact tables.
std::string toMarkdown(const QualityResults& results);

}  // namespace ardrone_vslam::quality
