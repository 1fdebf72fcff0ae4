// SPDX-License-Identifier: BSD-3-Clause
#include "input/v4l2_camera.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "input/grey_conversion.hpp"
#include "protocol/clocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kOldest_ns = 10'000'000'000;  // no camera delivers an image so late
constexpr int kMostErrors = 10;

V4l2Buffer mappedBuffer(std::uint32_t index = 0) {
  V4l2Buffer buffer{};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

}  // namespace

const V4l2Calls& kernelCalls() {
  static const V4l2Calls calls{
      [](const char* path) { return ::open(path, O_RDWR | O_NONBLOCK); },
      [](int fd, unsigned long request, void* argument) {
        int answer = 0;
        // musl's request is an int; the bits are the same.
        do answer = ::ioctl(fd, static_cast<decltype(_IO(0, 0))>(request), argument);
        while (answer < 0 && errno == EINTR);
        return answer;
      },
      [](std::size_t bytes, int fd, long offset) {
        void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, offset);
        return memory == MAP_FAILED ? nullptr : memory;
      },
      [](void* memory, std::size_t bytes) { ::munmap(memory, bytes); }};
  return calls;
}

V4l2Camera::V4l2Camera(const std::string& path, const FrameSize& size, clockid_t clock,
                       const V4l2Calls& calls)
    : path_(path),
      size_(size),
      clock_(clock),
      calls_(calls),
      device_(calls.open(path.c_str())),
      grey_(static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px)) {
  if (!device_.isOpen())
    throw std::runtime_error(path_ + ": cannot be opened (" + std::strerror(errno) +
                             "); is the stock controller still running?");
  try {
    setFormat();
    mapBuffers();
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    control(VIDIOC_STREAMON, &type, "does not start to stream");
  } catch (...) {
    for (std::size_t i = 0; i < mapped_; ++i) calls_.unmap(mappings_[i].memory, mappings_[i].bytes);
    throw;
  }
}

V4l2Camera::~V4l2Camera() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  calls_.control(device_.get(), VIDIOC_STREAMOFF, &type);
  for (std::size_t i = 0; i < mapped_; ++i) calls_.unmap(mappings_[i].memory, mappings_[i].bytes);
}

void V4l2Camera::control(unsigned long request, void* argument, const char* what) {
  if (calls_.control(device_.get(), request, argument) < 0)
    throw std::runtime_error(path_ + ": " + what + " (" + std::strerror(errno) + ")");
}

void V4l2Camera::setFormat() {
  v4l2_capability capability{};
  control(VIDIOC_QUERYCAP, &capability, "is no camera");
  if ((capability.capabilities & V4L2_CAP_VIDEO_CAPTURE) == 0 ||
      (capability.capabilities & V4L2_CAP_STREAMING) == 0)
    throw std::runtime_error(path_ + ": is no camera that streams");
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix.width = static_cast<std::uint32_t>(size_.sourceWidth_px());
  format.fmt.pix.height = static_cast<std::uint32_t>(size_.sourceHeight_px());
  format.fmt.pix.pixelformat = V4L2_PIX_FMT_UYVY;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  control(VIDIOC_S_FMT, &format, "refuses the format");
  const v4l2_pix_format& given = format.fmt.pix;
  if (given.pixelformat != V4L2_PIX_FMT_UYVY ||
      given.width != static_cast<std::uint32_t>(size_.sourceWidth_px()) ||
      given.height != static_cast<std::uint32_t>(size_.sourceHeight_px()))
    throw std::runtime_error(
        path_ + ": gives no UYVY of " + std::to_string(size_.sourceWidth_px()) + "x" +
        std::to_string(size_.sourceHeight_px()) + " but " + std::to_string(given.width) + "x" +
        std::to_string(given.height) + "; see the calibration's size and `halve`");
  const int least = 2 * size_.sourceWidth_px();
  row_bytes_ = std::max(static_cast<int>(given.bytesperline), least);
}

void V4l2Camera::mapBuffers() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  control(VIDIOC_REQBUFS, &request, "gives no buffers");
  if (request.count < 2) throw std::runtime_error(path_ + ": gives too few buffers");
  const std::size_t needed =
      static_cast<std::size_t>(row_bytes_) * static_cast<std::size_t>(size_.sourceHeight_px());
  for (std::uint32_t i = 0; i < std::min<std::size_t>(request.count, kBuffers); ++i) {
    V4l2Buffer buffer = mappedBuffer(i);
    control(kQueryBuffer, &buffer, "does not tell of its buffers");
    if (buffer.length < needed) throw std::runtime_error(path_ + ": its buffers are too small");
    void* memory = calls_.map(buffer.length, device_.get(), static_cast<long>(buffer.m.offset));
    if (memory == nullptr) throw std::runtime_error(path_ + ": its buffers cannot be mapped");
    mappings_[mapped_++] = {memory, buffer.length};
    control(kQueueBuffer, &buffer, "does not take its buffers");
  }
}

FrameSource::Read V4l2Camera::read(Frame& frame) {
  V4l2Buffer newest{};
  if (const Read answer = dequeue(newest); answer != Read::kFrame) return answer;
  while (true) {
    V4l2Buffer newer{};
    const Read more = dequeue(newer);
    if (more == Read::kNone) break;
    if (more != Read::kFrame) return more;
    ++dropped_;
    if (calls_.control(device_.get(), kQueueBuffer, &newest) < 0) return gone();
    newest = newer;
  }
  toGrey(PixelFormat::kUyvy, static_cast<const std::uint8_t*>(mappings_[newest.index].memory),
         row_bytes_, size_.sourceWidth_px(), size_.sourceHeight_px(), size_.halve, grey_.data());
  frame.image = {grey_.data(), size_.width_px, size_.height_px, size_.width_px};
  frame.stamp_ns = stampOf(std::int64_t{newest.timestamp.seconds} * 1'000'000'000 +
                           std::int64_t{newest.timestamp.microseconds} * 1000);
  return calls_.control(device_.get(), kQueueBuffer, &newest) < 0 ? gone() : Read::kFrame;
}

FrameSource::Read V4l2Camera::dequeue(V4l2Buffer& buffer) {
  buffer = mappedBuffer();
  while (calls_.control(device_.get(), kDequeueBuffer, &buffer) < 0) {
    if (errno == EAGAIN) return Read::kNone;
    if (errno != EIO || ++errors_ >= kMostErrors) return gone();
    buffer = mappedBuffer();  // an image was lost, the stream goes on
  }
  errors_ = 0;
  if (buffer.index >= mapped_) return lost(path_ + ": the driver gives a buffer that is none");
  return Read::kFrame;
}

FrameSource::Read V4l2Camera::gone() {
  return lost(path_ + ": the camera is gone (" + std::strerror(errno) + ")");
}

/// Old drivers stamp by the time of day, newer ones by the monotonic clock, some not at all.
std::int64_t V4l2Camera::stampOf(std::int64_t driver_ns) const {
  for (const clockid_t clock : {CLOCK_MONOTONIC, CLOCK_REALTIME}) {
    const std::int64_t age_ns = clock_ns(clock) - driver_ns;
    if (age_ns >= 0 && age_ns < kOldest_ns) return clock_ns(clock_) - age_ns;
  }
  return clock_ns(clock_);
}

}  // namespace ardrone_vslam
