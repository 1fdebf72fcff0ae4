// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "settings/settings.hpp"

namespace ardrone_vslam {

/// Checks this computer before a flight: processor, clock, kernels, memory and, when the
/// configuration names a camera's device, that. Prints a line for each. @return whether all are
/// good
bool selfTest(const Settings& settings);

/// FNV-1a of corners, descriptors and tracks of two generated images: equal on every processor.
std::uint64_t kernelHash();
constexpr std::uint64_t kGoldenHash = 0xa8c7f832281a39c5;

}  // namespace ardrone_vslam
