// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "configs/onboard_config.hpp"
#include "input/input_buffer.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam {

/// The controller's records as they come, by UDP or one after the other in a file or FIFO. A FIFO's
/// writer may go and come again. After bytes that are no record the next one is looked for.
class ObserverSource {
 public:
  enum class Read { kRecord, kNone, kEnd };

  /// @throws std::runtime_error
  ObserverSource(const OnboardConfig& config, int stop_fd);

  /// Whether records come by themselves and must be taken at once; those of a file wait.
  bool isLive() const { return socket_.isOpen() || is_fifo_; }
  int descriptor() const { return file_ ? file_->descriptor() : socket_.get(); }
  /// Whether read() of a file need not wait.
  bool hasMore() const { return file_ && file_->hasMore(); }
  /// Of one record, which may be wrong in every way. kNone: no whole one has come.
  Read read(const std::uint8_t*& record, std::size_t& size);

 private:
  Read readFile(const std::uint8_t*& record, std::size_t& size);
  void keepNextRecord();

  // Longer datagrams are wrong, and told by their size.
  std::array<std::uint8_t, VSLAM_OBSERVER_BYTES + 1> bytes_{};
  std::array<std::uint8_t, VSLAM_OBSERVER_BYTES> record_{};  // of the file
  FileDescriptor socket_;
  std::optional<InputBuffer> file_;
  std::size_t filled_ = 0;  // of a record of the file, in bytes_
  bool is_fifo_ = false;
};

}  // namespace ardrone_vslam
