// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/udp.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace ardrone_vslam {
namespace {

template <class Use>
FileDescriptor openSocket(const std::string& address, int port, const char* purpose,
                          const Use& use) {
  const std::string name = address + ":" + std::to_string(port);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, address.c_str(), &to.sin_addr) != 1)
    throw std::runtime_error(name + ": is no address; write it as 192.168.1.1");
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM, 0));
  if (!socket.isOpen() || ::fcntl(socket.get(), F_SETFL, O_NONBLOCK) != 0 ||
      use(socket.get(), reinterpret_cast<const sockaddr*>(&to), socklen_t{sizeof to}) != 0)
    throw std::runtime_error(name + ": " + purpose + ": " + std::strerror(errno));
  return socket;
}

}  // namespace

FileDescriptor receiveAt(const std::string& address, int port) {
  return openSocket(address, port, "cannot receive there", ::bind);
}

FileDescriptor sendTo(const std::string& address, int port) {
  return openSocket(address, port, "cannot send there", ::connect);
}

int portOf(int socket) {
  sockaddr_in at{};
  socklen_t size = sizeof at;
  if (::getsockname(socket, reinterpret_cast<sockaddr*>(&at), &size) != 0) return -1;
  return ntohs(at.sin_port);
}

long receive(const FileDescriptor& socket, std::uint8_t* to, std::size_t capacity) {
  return ::recv(socket.get(), to, capacity, MSG_TRUNC);
}

}  // namespace ardrone_vslam
