// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// The datagrams that come to an address of this computer, by a thread of its own.
class DatagramReceiver {
 public:
  /// @throws std::runtime_error with what helps
  explicit DatagramReceiver(const std::string& address);
  ~DatagramReceiver();

  /// Address and port.
  const std::string& at() const { return at_; }
  /// @param take  called by the thread, until the receiver ends
  void start(const std::function<void(const std::uint8_t* datagram, std::size_t size)>& take);

 private:
  FileDescriptor socket_;
  std::string at_;
  std::atomic<bool> is_stopping_{false};
  std::thread thread_;
};

}  // namespace ardrone_vslam
