// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/file_advice.hpp"

#include <cerrno>

namespace ardrone_vslam {

std::string fileAdvice(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "check the path; its folder must be there";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place where this user may read and write";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room, or choose another disk";
    case EISDIR:
      return "name a file";
    default:
      return "try again, or choose another disk";
  }
}

std::string otherKindOfFile(mode_t mode) {
  if (S_ISREG(mode)) return {};
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

}  // namespace ardrone_vslam
