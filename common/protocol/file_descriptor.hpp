// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>
#include <unistd.h>

#include <utility>

namespace ardrone_vslam {

/// Owns a file descriptor.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }

  int get() const { return fd_; }
  bool isOpen() const { return fd_ >= 0; }

 private:
  int fd_;
};

/// Whether there is something to read, or an end of it.
inline bool isReadable(int fd, int wait_ms = 0) {
  pollfd entry{fd, POLLIN, 0};
  return ::poll(&entry, 1, wait_ms) > 0;
}

}  // namespace ardrone_vslam
