// SPDX-License-Identifier: BSD-3-Clause
#include "observer_source.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "udp.hpp"

namespace ardrone_vslam {

ObserverSource::ObserverSource(const OnboardConfig& config, int stop_fd) {
  if (config.observer.empty()) {
    socket_ = receiveAt(config.observer_address, config.observer_port);
    return;
  }
  FileDescriptor file(::open(config.observer.c_str(), O_RDONLY));
  if (!file.isOpen())
    throw std::runtime_error(config.observer + ": cannot be read: " + std::strerror(errno));
  file_.emplace(std::move(file), stop_fd);
}

ObserverSource::Read ObserverSource::read(const std::uint8_t*& record, std::size_t& size) {
  record = bytes_.data();
  if (file_) {
    while (filled_ < VSLAM_OBSERVER_BYTES) {
      if (!file_->hasMore()) return Read::kNone;
      const std::size_t got =
          file_->readSome(bytes_.data() + filled_, VSLAM_OBSERVER_BYTES - filled_);
      if (got == 0 && filled_ == 0) return Read::kEnd;
      if (got == 0) break;
      filled_ += got;
    }
    size = std::exchange(filled_, 0);
    return Read::kRecord;
  }
  const long got = receive(socket_, bytes_.data(), bytes_.size());
  if (got < 0) return Read::kNone;
  size = std::min(static_cast<std::size_t>(got), bytes_.size());
  return Read::kRecord;
}

}  // namespace ardrone_vslam
