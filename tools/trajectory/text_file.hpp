// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// Writes text to a file, whole or not at all: an interrupted write leaves the file before.
/// @throws std::runtime_error naming the file
void writeText(const std::string& path, const std::string& text);

}  // namespace ardrone_vslam
