// SPDX-License-Identifier: BSD-3-Clause
#include "input/v4l2_camera.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <deque>
#include <vector>

#include "input/frame_input.hpp"
#include "input/v4l2_buffer.hpp"
#include "protocol/clocks.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr FrameSize kSize{8, 4, true};  // of 16 x 8

/// A camera in place of the kernel's; one at a time.
struct FakeCamera {
  std::uint32_t width_px = 16;
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  int dequeue_error = EAGAIN;  // when there is no image
  std::int64_t stamp_ns = 0;
  std::vector<std::vector<std::uint8_t>> buffers;
  std::deque<std::uint32_t> queued;
  std::deque<std::uint32_t> filled;
  int mapped = 0;
  bool is_streaming = false;

  void shoot(std::uint8_t grey) {
    ASSERT_FALSE(queued.empty()) << "the program keeps the buffers";
    std::vector<std::uint8_t>& buffer = buffers[queued.front()];
    for (std::size_t i = 0; i < buffer.size(); ++i) buffer[i] = i % 2 == 0 ? 128 : grey;
    filled.push_back(queued.front());
    queued.pop_front();
  }
  int control(unsigned long request, void* argument);
};
FakeCamera* fake = nullptr;

int FakeCamera::control(unsigned long request, void* argument) {
  const auto fail = [](int error) {
    errno = error;
    return -1;
  };
  auto* buffer = static_cast<V4l2Buffer*>(argument);
  if (request == VIDIOC_QUERYCAP) {
    static_cast<v4l2_capability*>(argument)->capabilities = capabilities;
  } else if (request == VIDIOC_S_FMT) {
    v4l2_pix_format& pixels = static_cast<v4l2_format*>(argument)->fmt.pix;
    pixels.width = width_px;
    pixels.bytesperline = 2 * width_px + 6;  // rows with something behind them
  } else if (request == VIDIOC_REQBUFS) {
    static_cast<v4l2_requestbuffers*>(argument)->count = 3;
    buffers.assign(3, std::vector<std::uint8_t>(std::size_t{2 * width_px + 6} * 8));
  } else if (request == kQueryBuffer) {
    buffer->length = static_cast<std::uint32_t>(buffers[buffer->index].size());
    buffer->m.offset = buffer->index;
  } else if (request == kQueueBuffer) {
    queued.push_back(buffer->index);
  } else if (request == kDequeueBuffer) {
    if (filled.empty()) return fail(dequeue_error);
    buffer->index = filled.front();
    buffer->timestamp.seconds = static_cast<long>(stamp_ns / 1'000'000'000);
    buffer->timestamp.microseconds = static_cast<long>(stamp_ns % 1'000'000'000 / 1000);
    filled.pop_front();
  } else if (request == VIDIOC_STREAMON || request == VIDIOC_STREAMOFF) {
    is_streaming = request == VIDIOC_STREAMON;
  } else {
    return fail(EINVAL);
  }
  return 0;
}

const V4l2Calls kFakeCalls{
    [](const char*) { return ::open("/dev/null", O_RDWR); },
    [](int, unsigned long request, void* argument) { return fake->control(request, argument); },
    [](std::size_t, int, long offset) -> void* {
      ++fake->mapped;
      return fake->buffers[static_cast<std::size_t>(offset)].data();
    },
    [](void*, std::size_t) { --fake->mapped; }};

class V4l2CameraTest : public ::testing::Test {
 protected:
  V4l2CameraTest() { fake = &camera_; }
  std::string faultOf() {
    try {
      V4l2Camera("fake", kSize, CLOCK_MONOTONIC, kFakeCalls);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }

  FakeCamera camera_;
};

TEST_F(V4l2CameraTest, TheNewestImageWinsAndBuffersGoBack) {
  {
    V4l2Camera camera("fake", kSize, CLOCK_MONOTONIC, kFakeCalls);
    Frame frame;
    EXPECT_EQ(camera.read(frame), FrameSource::Read::kNone);
    for (std::uint8_t grey = 1; grey <= 9; ++grey) {
      camera_.shoot(grey);
      camera_.shoot(static_cast<std::uint8_t>(100 + grey));
      ASSERT_EQ(camera.read(frame), FrameSource::Read::kFrame);
      for (int i = 0; i < 32; ++i) ASSERT_EQ(frame.image.data[i], 100 + grey) << i;
    }
    EXPECT_EQ(camera.dropped(), 9U);
    EXPECT_EQ(camera_.queued.size(), 3U);
    EXPECT_TRUE(camera_.is_streaming);
  }
  EXPECT_FALSE(camera_.is_streaming);
  EXPECT_EQ(camera_.mapped, 0);
}

TEST_F(V4l2CameraTest, StampsAreOfTheClockAskedForWhicheverTheDriverUsed) {
  constexpr std::int64_t kAge_ns = 50'000'000;
  constexpr std::int64_t kSlew_ns = 1'000'000;
  for (const clockid_t wanted : {CLOCK_MONOTONIC, CLOCK_REALTIME}) {
    for (const clockid_t of_driver : {CLOCK_MONOTONIC, CLOCK_REALTIME}) {
      V4l2Camera camera("fake", kSize, wanted, kFakeCalls);
      const std::int64_t before = clock_ns(wanted);
      camera_.stamp_ns = clock_ns(of_driver) - kAge_ns;
      camera_.queued.clear();
      camera_.queued.push_back(0);
      camera_.shoot(1);
      Frame frame;
      ASSERT_EQ(camera.read(frame), FrameSource::Read::kFrame);
      // The clocks were read in this order; the time of day may be slewed meanwhile.
      EXPECT_GE(frame.stamp_ns, before - kAge_ns - kSlew_ns);
      EXPECT_LE(frame.stamp_ns, clock_ns(wanted) - kAge_ns + kSlew_ns);
      camera_.queued.clear();
    }
  }
}

TEST_F(V4l2CameraTest, ASilentCameraIsOpenedAgain) {
  constexpr std::int64_t kOneSecond_ns = 1'000'000'000;
  OnboardConfig config;
  config.frames = "/dev/null";  // a device; the calls are the test's
  FrameInput input(config, kSize, -1, {}, kFakeCalls);
  ASSERT_FALSE(input.isLost());
  fake->stamp_ns = now_ns();
  fake->shoot(7);
  Frame frame;
  ASSERT_EQ(input.read(frame), FrameSource::Read::kFrame);
  const std::int64_t heard_ns = now_ns();
  input.closeSilent(heard_ns + kOneSecond_ns / 2);
  EXPECT_FALSE(input.isLost());
  input.closeSilent(heard_ns + kOneSecond_ns);
  EXPECT_TRUE(input.isLost());
  EXPECT_FALSE(input.isOver());
  EXPECT_FALSE(fake->is_streaming);
  input.openAgain(heard_ns + kOneSecond_ns * 3 / 2);
  EXPECT_TRUE(input.isLost()) << "it is left alone for a second";
  input.openAgain(heard_ns + 2 * kOneSecond_ns);
  EXPECT_FALSE(input.isLost());
  fake->queued.clear();
}

TEST_F(V4l2CameraTest, ALostCameraIsSaid) {
  V4l2Camera camera("fake", kSize, CLOCK_MONOTONIC, kFakeCalls);
  Frame frame;
  camera_.dequeue_error = ENODEV;
  EXPECT_EQ(camera.read(frame), FrameSource::Read::kLost);
  EXPECT_NE(camera.fault().find("gone"), std::string::npos);
  camera_.dequeue_error = EIO;  // forever
  EXPECT_EQ(camera.read(frame), FrameSource::Read::kLost);
}

TEST_F(V4l2CameraTest, WhatIsNoSuchCameraIsRefusedWithNothingLeftMapped) {
  EXPECT_EQ(faultOf(), "");
  camera_.width_px = 20;
  EXPECT_NE(faultOf().find("20x8"), std::string::npos);
  camera_.width_px = 16;
  camera_.capabilities = V4L2_CAP_VIDEO_OUTPUT;
  EXPECT_NE(faultOf().find("no camera"), std::string::npos);
  EXPECT_EQ(camera_.mapped, 0);
}

TEST(V4l2Device, MissingOrAnotherIsSaid) {
  for (const char* path : {"/dev/ardrone_vslam_none", "/dev/null"}) {
    try {
      V4l2Camera(path, kSize, CLOCK_MONOTONIC);
      FAIL() << path;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
