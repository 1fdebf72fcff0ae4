// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "input/frame_source.hpp"
#include "input/v4l2_buffer.hpp"
#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// The calls of the kernel that the camera needs; a test puts a camera of its own there.
struct V4l2Calls {
  int (*open)(const char* path);
  int (*control)(int fd, unsigned long request, void* argument);
  void* (*map)(std::size_t bytes, int fd, long offset);
  void (*unmap)(void* memory, std::size_t bytes);
};
const V4l2Calls& kernelCalls();

/// A V4L2 camera that streams UYVY into mapped buffers. Its newest image wins. Images are stamped
/// by `clock`, whichever clock the driver has used.
class V4l2Camera : public FrameSource {
 public:
  /// @throws std::runtime_error saying what is wrong with the device
  V4l2Camera(const std::string& path, const FrameSize& size, clockid_t clock,
             const V4l2Calls& calls = kernelCalls());
  ~V4l2Camera() override;

  int descriptor() const override { return device_.get(); }
  Read read(Frame& frame) override;

 private:
  struct Mapping {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };

  void control(unsigned long request, void* argument, const char* what);
  void setFormat();
  void mapBuffers();
  Read dequeue(V4l2Buffer& buffer);
  Read gone();
  std::int64_t stampOf(std::int64_t driver_ns) const;

  static constexpr std::size_t kBuffers = 4;

  std::string path_;
  FrameSize size_;
  clockid_t clock_;
  const V4l2Calls& calls_;
  FileDescriptor device_;
  int row_bytes_ = 0;
  int errors_ = 0;  // in a row
  std::array<Mapping, kBuffers> mappings_;
  std::size_t mapped_ = 0;
  std::vector<std::uint8_t> grey_;
};

}  // namespace ardrone_vslam
