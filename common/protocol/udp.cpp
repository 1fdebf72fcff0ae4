// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/udp.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "yaml/yaml_sections.hpp"

namespace ardrone_vslam {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw std::runtime_error(text + ": is no address; write it as 192.168.1.1:5580");
}

template <class Use>
FileDescriptor openSocket(const UdpAddress& address, const char* purpose, const Use& use) {
  const std::string name = address.host + ":" + std::to_string(address.port);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (::inet_pton(AF_INET, address.host.c_str(), &to.sin_addr) != 1) refuse(name);
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM, 0));
  if (!socket.isOpen() || ::fcntl(socket.get(), F_SETFL, O_NONBLOCK) != 0 ||
      use(socket.get(), reinterpret_cast<const sockaddr*>(&to), socklen_t{sizeof to}) != 0)
    throw std::runtime_error(name + ": " + purpose + ": " + std::strerror(errno));
  return socket;
}

}  // namespace

UdpAddress udpAddressOf(const std::string& text, int default_port) {
  constexpr int kLargestPort = 65535;
  const std::size_t colon = text.find(':');
  UdpAddress address{text.substr(0, colon), default_port};
  if (colon == std::string::npos) return address;
  const std::string port = text.substr(colon + 1);
  if (!toNumber(port, address.port) || address.port < 0 || address.port > kLargestPort)
    refuse(text);
  return address;
}

bool isUdpAddress(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.substr(0, text.find(':')).c_str(), &address) == 1;
}

FileDescriptor receiveAt(const UdpAddress& address) {
  return openSocket(address, "cannot receive there", ::bind);
}

FileDescriptor sendTo(const UdpAddress& address) {
  return openSocket(address, "cannot send there", ::connect);
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
