// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// Reads a file or FIFO through a buffer of fixed size, and gives up when the program is to stop.
class InputBuffer {
 public:
  static constexpr int kWaiting_ms = 100;

  /// @param stop_fd  becomes readable when the program is to stop; negative: never
  /// @param waiting  called every kWaiting_ms while nothing comes
  InputBuffer(FileDescriptor file, int stop_fd, std::function<void()> waiting = {})
      : file_(std::move(file)), stop_fd_(stop_fd), waiting_(std::move(waiting)) {}

  /// The next byte, or -1 at the end.
  int next();
  /// @return how many of `count` bytes there were before the end
  std::size_t read(std::uint8_t* to, std::size_t count);
  /// What there is without waiting for more. @pre hasMore() @return 0 at the end
  std::size_t readSome(std::uint8_t* to, std::size_t count);
  /// Whether next() has something without waiting for it (or the end).
  bool hasMore() const { return begin_ < end_ || isReadable(file_.get()); }
  /// Why the end came, as errno; 0: it is the end.
  int error() const { return error_; }
  /// The end came because the program is to stop.
  bool isStopped() const { return is_stopped_; }
  int descriptor() const { return file_.get(); }
  /// Bytes that poll() on the descriptor does not know of.
  bool isBuffered() const { return begin_ < end_; }

 private:
  /// @return 1: the file can be read; 0: not now; -1: see errno
  int wait();
  std::size_t fill(std::uint8_t* to, std::size_t count);

  FileDescriptor file_;
  int stop_fd_;
  std::function<void()> waiting_;
  bool is_stopped_ = false;
  int error_ = 0;
  std::array<std::uint8_t, 4096> bytes_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace ardrone_vslam
