// SPDX-License-Identifier: BSD-3-Clause
// Replaces the C library's malloc and its kin, which both glibc and musl allow a program to do. One
// thread: nothing here is locked.
#include "program_memory.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

#include "memory/fixed_heap.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kFirst_bytes = 512 * 1024;
constexpr std::size_t kStack_bytes = 256 * 1024;

alignas(FixedHeap::kAlignment) unsigned char first_memory[kFirst_bytes];
FixedHeap heap;

void* allocate(std::size_t bytes, std::size_t alignment = FixedHeap::kAlignment) {
  if (heap.capacity() == 0) heap.add(first_memory, sizeof first_memory);
  void* memory = heap.allocate(bytes, alignment);
  if (memory == nullptr) errno = ENOMEM;
  return memory;
}

/// The stack grows when it is touched: up to here now.
__attribute__((noinline)) void touchStack() {
  volatile unsigned char bytes[kStack_bytes];
  for (std::size_t i = 0; i < sizeof bytes; i += 4096) bytes[i] = 0;
}

}  // namespace

void takeMemory(std::size_t bytes, bool lock) {
  void* region = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (region == MAP_FAILED)
    throw std::runtime_error(
        "out of memory: " + std::to_string(bytes / 1'000'000) +
        " MB (working_mb, and 400 bytes for each of max_landmarks) cannot be had: " +
        std::strerror(errno) + "; end other programs, or set max_landmarks or max_map_mb lower");
  std::memset(region, 0, bytes);
  touchStack();
  if (lock && ::mlockall(MCL_CURRENT) != 0)
    std::fprintf(stderr, "vslam_onboard: memory is not locked: %s; it needs root\n",
                 std::strerror(errno));
  for (std::size_t at = 0; at < bytes; at += FixedHeap::kLargestRegion)
    heap.add(static_cast<unsigned char*>(region) + at,
             std::min(bytes - at, FixedHeap::kLargestRegion));
}

MemoryUse memoryUse() {
  return {heap.mostUsed(), heap.capacity()};
}

}  // namespace ardrone_vslam

using ardrone_vslam::allocate;
using ardrone_vslam::FixedHeap;

// A sanitizer has a malloc of its own; the heap above then lies idle.
#if !defined(__SANITIZE_ADDRESS__)
extern "C" {

void* malloc(std::size_t bytes) {
  return allocate(bytes);
}

void free(void* memory) {
  ardrone_vslam::heap.release(memory);
}

void* calloc(std::size_t count, std::size_t bytes) {
  std::size_t all = 0;
  if (__builtin_mul_overflow(count, bytes, &all)) {
    errno = ENOMEM;
    return nullptr;
  }
  void* memory = allocate(all);
  if (memory != nullptr) std::memset(memory, 0, all);
  return memory;
}

void* realloc(void* memory, std::size_t bytes) {
  if (memory == nullptr) return allocate(bytes);
  const std::size_t now = FixedHeap::sizeOf(memory);
  if (bytes <= now && bytes >= now / 2) return memory;
  void* moved = allocate(bytes);
  if (moved == nullptr) return nullptr;
  std::memcpy(moved, memory, std::min(bytes, now));
  free(memory);
  return moved;
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return allocate(bytes, alignment);
}

void* memalign(std::size_t alignment, std::size_t bytes) {
  return allocate(bytes, alignment);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) {
  const int before = errno;
  void* const got = allocate(bytes, alignment);
  errno = before;
  if (got == nullptr) return ENOMEM;
  *memory = got;
  return 0;
}

std::size_t malloc_usable_size(void* memory) {
  return memory == nullptr ? 0 : FixedHeap::sizeOf(memory);
}

}  // extern "C"
#endif
