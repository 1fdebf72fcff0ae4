// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// Runs one nodelet as a node of its own until it is stopped.
/// @param name  default node name
/// @param type  the nodelet's name in nodelet_plugins.xml
/// @return exit code: 0, 1 when the nodelet cannot start, 2 for a wrong argument
int runStandalone(int argc, char** argv, const std::string& name, const std::string& type);

}  // namespace ardrone_vslam
