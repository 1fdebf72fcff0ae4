// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// Every parameter of the tracker, the mapper and the nodelets as Markdown tables: name, default,
/// unit, range, effect. docs/parameters.md is this text (a test holds them together).
std::string parameterTable();

}  // namespace ardrone_vslam
