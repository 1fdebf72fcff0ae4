// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// Where datagrams come from or go to.
struct UdpAddress {
  std::string host;  ///< 192.168.1.1
  int port = 0;
};

/// Of ADDRESS or ADDRESS:PORT. @throws std::runtime_error for anything else
UdpAddress udpAddressOf(const std::string& text, int default_port);
/// Whether it begins with an address, and is no file's name.
bool isUdpAddress(const std::string& text);

/// A non-blocking UDP socket that receives at an address. @throws std::runtime_error
FileDescriptor receiveAt(const UdpAddress& address);

/// A non-blocking UDP socket that sends to an address. @throws std::runtime_error
FileDescriptor sendTo(const UdpAddress& address);

/// The port that a socket receives at (of one opened with port 0: any that is free).
int portOf(int socket);

/// @return the size of the datagram, also when it is larger than `capacity`; negative without one
long receive(const FileDescriptor& socket, std::uint8_t* to, std::size_t capacity);

}  // namespace ardrone_vslam
