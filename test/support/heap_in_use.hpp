// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <malloc.h>

#include <cstddef>

namespace ardrone_vslam::test {

/// Bytes that the program has from malloc and has not given back; 0 where the C library does not
/// tell.
inline std::size_t heapInUse_bytes() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
#elif defined(__GLIBC__)
  const struct mallinfo heap = mallinfo();
  return static_cast<unsigned>(heap.uordblks) + static_cast<unsigned>(heap.hblkhd);
#else
  return 0;
#endif
}

}  // namespace ardrone_vslam::test
