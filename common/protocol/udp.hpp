// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// A non-blocking UDP socket that receives at an address. @throws std::runtime_error
FileDescriptor receiveAt(const std::string& address, int port);

/// A non-blocking UDP socket that sends to an address. @throws std::runtime_error
FileDescriptor sendTo(const std::string& address, int port);

/// The port that a socket receives at (of one opened with port 0: any that is free).
int portOf(int socket);

/// @return the size of the datagram, also when it is larger than `capacity`; negative without one
long receive(const FileDescriptor& socket, std::uint8_t* to, std::size_t capacity);

}  // namespace ardrone_vslam
