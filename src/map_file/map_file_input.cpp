// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/map_file_input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "map_file/file_advice.hpp"
#include "map_file/map_sections.hpp"

namespace ardrone_vslam {
namespace {

[[noreturn]] void fail(int error) {
  throw MapFileError(std::string("the map cannot be read: ") + std::strerror(error) + "; " +
                     fileAdvice(error));
}

/// @return bytes
std::uint64_t mapSize(const struct stat& status) {
  const std::string kind = otherKindOfFile(status.st_mode);
  if (!kind.empty()) throw MapFileError("this is " + kind + "; name a map file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > kMostMapBytes)
    throw MapFileError("the file is larger than 2 GiB, which no map is; name a map file");
  if (size < kMapHeaderSize)
    throw MapFileError("the file ends after " + std::to_string(size) +
                       " bytes, too few for a map; use another copy");
  return size;
}

}  // namespace

MapFileInput::MapFileInput(const std::string& path) {
  struct stat status = {};
  // To open a device can set it going.
  if (::stat(path.c_str(), &status) != 0) fail(errno);
  mapSize(status);
  // It may have become a pipe meanwhile, whose other end nobody opens.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) fail(errno);
  try {
    if (::fstat(descriptor_, &status) != 0) fail(errno);
    size_ = mapSize(status);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

MapFileInput::~MapFileInput() {
  ::close(descriptor_);
}

void MapFileInput::read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) const {
  constexpr std::size_t kMostAtOnce = 1U << 30U;  // one call may not take more than 2 GiB
  while (count > 0) {
    const ssize_t got =
        ::pread(descriptor_, bytes, std::min(count, kMostAtOnce), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(errno);
    if (got == 0) throw MapFileError("the file became shorter while it was read; try again");
    const auto taken = static_cast<std::size_t>(got);
    bytes += taken;
    count -= taken;
    offset += taken;
  }
}

}  // namespace ardrone_vslam
