// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// Removes the files that an earlier run, of one or of several seeds, left in the folder, so that
/// none of them is taken for the next run's. The run's own summary.json tells what it wrote;
/// without one nothing is removed, and files of other names never are.
void removeEarlierRun(const std::string& folder);

}  // namespace ardrone_vslam
