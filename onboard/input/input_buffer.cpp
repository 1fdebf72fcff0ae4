// SPDX-License-Identifier: BSD-3-Clause
#include "input/input_buffer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ardrone_vslam {

int InputBuffer::wait() {
  std::array<pollfd, 2> entries{{{file_.get(), POLLIN, 0}, {stop_fd_, POLLIN, 0}}};
  const int ready = ::poll(entries.data(), entries.size(), waiting_ ? kWaiting_ms : -1);
  if (ready < 0) return ready;
  if (ready == 0) waiting_();
  is_stopped_ = entries[1].revents != 0;
  return !is_stopped_ && entries[0].revents != 0 ? 1 : 0;
}

std::size_t InputBuffer::fill(std::uint8_t* to, std::size_t count) {
  while (!is_stopped_) {
    const int ready = wait();
    if (ready == 0) continue;
    const ssize_t got = ready > 0 ? ::read(file_.get(), to, count) : -1;
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR && errno != EAGAIN) {
      error_ = errno;
      return 0;
    }
  }
  return 0;
}

int InputBuffer::next() {
  if (begin_ == end_) {
    begin_ = 0;
    end_ = fill(bytes_.data(), bytes_.size());
    if (end_ == 0) return -1;
  }
  return bytes_[begin_++];
}

std::size_t InputBuffer::readSome(std::uint8_t* to, std::size_t count) {
  return isBuffered() ? read(to, std::min(count, end_ - begin_)) : fill(to, count);
}

std::size_t InputBuffer::read(std::uint8_t* to, std::size_t count) {
  std::size_t done = std::min(count, end_ - begin_);
  std::memcpy(to, bytes_.data() + begin_, done);
  begin_ += done;
  while (done < count) {
    const std::size_t got = fill(to + done, count - done);
    if (got == 0) break;
    done += got;
  }
  return done;
}

}  // namespace ardrone_vslam
