// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/datagram_receiver.hpp"

#include <stdexcept>
#include <vector>

#include "protocol/udp.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kStop_ms = 100;  // how late the thread may notice that it is to end
constexpr std::size_t kLargestDatagram = 65536;
constexpr int kPort = 5582;

}  // namespace

DatagramReceiver::DatagramReceiver(const std::string& address) {
  try {
    const UdpAddress own = udpAddressOf(address, kPort);
    socket_ = receiveAt(own);
    at_ = own.host + ":" + std::to_string(portOf(socket_.get()));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(std::string(e.what()) +
                             "; set `address` to one of this computer (0.0.0.0: all), and a port "
                             "that no other program receives at");
  }
}

DatagramReceiver::~DatagramReceiver() {
  is_stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void DatagramReceiver::start(
    const std::function<void(const std::uint8_t* datagram, std::size_t size)>& take) {
  thread_ = std::thread([this, take] {
    std::vector<std::uint8_t> datagram(kLargestDatagram);
    while (!is_stopping_) {
      if (!isReadable(socket_.get(), kStop_ms)) continue;
      const long size = receive(socket_, datagram.data(), datagram.size());
      if (size >= 0) take(datagram.data(), static_cast<std::size_t>(size));
    }
  });
}

}  // namespace ardrone_vslam
