// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/stat.h>

#include <string>

namespace ardrone_vslam {

/// What helps when the file system refuses with this errno.
std::string fileAdvice(int error);

/// "a folder", "a pipe", ...; empty for a regular file.
std::string otherKindOfFile(mode_t mode);

}  // namespace ardrone_vslam
