// SPDX-License-Identifier: BSD-3-Clause
#include "input/observer_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "protocol/udp.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kObserverPort = 5580;

}  // namespace

ObserverSource::ObserverSource(const OnboardConfig& config, int stop_fd) {
  if (isUdpAddress(config.observer)) {
    socket_ = receiveAt(udpAddressOf(config.observer, kObserverPort));
    return;
  }
  struct stat status {};
  is_fifo_ = ::stat(config.observer.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
  // A FIFO that it could write to itself never ends, and needs no writer to be opened.
  FileDescriptor file(::open(config.observer.c_str(), is_fifo_ ? O_RDWR : O_RDONLY));
  if (!file.isOpen())
    throw std::runtime_error(config.observer + ": cannot be read: " + std::strerror(errno));
  file_.emplace(std::move(file), stop_fd);
}

ObserverSource::Read ObserverSource::read(const std::uint8_t*& record, std::size_t& size) {
  if (file_) return readFile(record, size);
  record = bytes_.data();
  const long got = receive(socket_, bytes_.data(), bytes_.size());
  if (got < 0) return Read::kNone;
  size = std::min(static_cast<std::size_t>(got), bytes_.size());
  return Read::kRecord;
}

ObserverSource::Read ObserverSource::readFile(const std::uint8_t*& record, std::size_t& size) {
  while (filled_ < VSLAM_OBSERVER_BYTES) {
    if (!file_->hasMore()) return Read::kNone;
    const std::size_t got =
        file_->readSome(bytes_.data() + filled_, VSLAM_OBSERVER_BYTES - filled_);
    if (got == 0 && file_->error() != 0)
      std::fprintf(stderr, "vslam_onboard: the observer's records cannot be read: %s\n",
                   std::strerror(file_->error()));
    if (got == 0 && filled_ == 0) return Read::kEnd;
    if (got == 0) break;
    filled_ += got;
  }
  size = std::exchange(filled_, 0);
  std::copy_n(bytes_.begin(), size, record_.begin());
  record = record_.data();
  if (vslam_check(record, size, VSLAM_KIND_OBSERVER, VSLAM_OBSERVER_BYTES) != VSLAM_GOOD)
    keepNextRecord();
  return Read::kRecord;
}

/// What may be the next record's beginning stays.
void ObserverSource::keepNextRecord() {
  std::array<std::uint8_t, 4> magic;
  vslam_put(magic.data(), VSLAM_MAGIC, magic.size());
  for (std::size_t at = 1; at < VSLAM_OBSERVER_BYTES; ++at) {
    const std::size_t known = std::min(magic.size(), VSLAM_OBSERVER_BYTES - at);
    if (std::memcmp(&record_[at], magic.data(), known) != 0) continue;
    filled_ = VSLAM_OBSERVER_BYTES - at;
    std::copy_n(record_.begin() + static_cast<std::ptrdiff_t>(at), filled_, bytes_.begin());
    return;
  }
}

}  // namespace ardrone_vslam
