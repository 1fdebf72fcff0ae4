// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// The script `evaluate`, looked for beside the running program (installed), then in the source
/// folder that it was built from. @throws std::runtime_error saying where it was looked for
std::string findEvaluateScript();

/// Has the script write report.html and evaluation.json (kPageFiles) of the run, or of the several
/// seeds' runs, in the folder. What the script prints goes to the terminal.
/// @throws std::runtime_error when it cannot; the script has said why
void writeRunPage(const std::string& script, const std::string& folder);

}  // namespace ardrone_vslam
