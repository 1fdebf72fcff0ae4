// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cstdint>

namespace ardrone_vslam {

/// `struct v4l2_buffer` as the kernel of a drone knows it, with a `timeval` of two longs. With a C
/// library whose time is of 64 bits also on 32-bit processors (musl 1.2), the header's struct, and
/// with it the requests' numbers, is one that Linux 2.6.32 lacks; and musl's own fall-back waits
/// for ENOTTY where that kernel answers EINVAL.
struct V4l2Buffer {
  std::uint32_t index;
  std::uint32_t type;
  std::uint32_t bytesused;
  std::uint32_t flags;
  std::uint32_t field;
  struct {
    long seconds;
    long microseconds;
  } timestamp;
  v4l2_timecode timecode;
  std::uint32_t sequence;
  std::uint32_t memory;
  union {
    std::uint32_t offset;
    unsigned long userptr;
  } m;
  std::uint32_t length;
  std::uint32_t reserved2;
  std::uint32_t reserved;
};
static_assert(sizeof(V4l2Buffer) == (sizeof(long) == 8 ? 88 : 68), "the kernel's v4l2_buffer");

constexpr unsigned long kQueryBuffer = _IOWR('V', 9, V4l2Buffer);
constexpr unsigned long kQueueBuffer = _IOWR('V', 15, V4l2Buffer);
constexpr unsigned long kDequeueBuffer = _IOWR('V', 17, V4l2Buffer);

}  // namespace ardrone_vslam
