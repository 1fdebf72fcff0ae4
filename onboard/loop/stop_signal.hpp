// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam {

/// SIGTERM and SIGINT -> a descriptor that becomes readable, and stays so. One for the process.
/// @throws std::runtime_error
int installStopSignal();

}  // namespace ardrone_vslam
