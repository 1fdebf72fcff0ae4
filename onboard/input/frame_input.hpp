// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "configs/onboard_config.hpp"
#include "input/frame_source.hpp"
#include "input/v4l2_camera.hpp"
#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// The source of images that the configuration names. A camera that is missing, or goes, is looked
/// for again each second; a file that is not good is a fault for good.
class FrameInput {
 public:
  /// A camera that says nothing for so long counts as lost.
  static constexpr std::int64_t kSilent_ns = 1'000'000'000;

  /// @param waiting  called now and then while an image has begun to come and does not go on
  FrameInput(const OnboardConfig& config, const FrameSize& size, int stop_fd,
             std::function<void()> waiting = {}, const V4l2Calls& calls = kernelCalls());

  /// To poll; negative while there is no source.
  int descriptor() const { return source_ ? source_->descriptor() : -1; }
  bool isBuffered() const { return source_ && source_->isBuffered(); }
  bool hasMore() const { return isBuffered() || (source_ && isReadable(descriptor())); }
  FrameSource::Read read(Frame& frame);
  /// Opens the camera, if it is time to. Says on standard error what happens.
  void openAgain(std::int64_t now_ns);

  /// Gives a camera up that has sent nothing for kSilent_ns; openAgain() then tries it anew.
  void closeSilent(std::int64_t now_ns);

  bool isLost() const { return !source_; }
  /// Lost, and not to come back.
  bool isOver() const { return !source_ && !is_device_; }
  std::uint32_t dropped() const { return dropped_ + (source_ ? source_->dropped() : 0); }

 private:
  void open();
  void say(const std::string& fault);

  OnboardConfig config_;
  FrameSize size_;
  int stop_fd_;
  std::function<void()> waiting_;
  const V4l2Calls& calls_;
  bool is_device_;
  std::unique_ptr<FrameSource> source_;
  std::uint32_t dropped_ = 0;  // of sources before
  std::int64_t tried_ns_ = 0;
  std::int64_t heard_ns_ = 0;
  std::string said_;
};

}  // namespace ardrone_vslam
