// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "input/frame_stream.hpp"
#include "protocol/clocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kTryAgain_ns = 1'000'000'000;

/// Also one that is not there (yet).
bool isDevice(const std::string& path) {
  struct stat status {};
  if (path == "-") return false;
  if (::stat(path.c_str(), &status) != 0) return path.compare(0, 5, "/dev/") == 0;
  return S_ISCHR(status.st_mode);
}

}  // namespace

FrameInput::FrameInput(const OnboardConfig& config, const FrameSize& size, int stop_fd,
                       std::function<void()> waiting, const V4l2Calls& calls)
    : config_(config),
      size_(size),
      stop_fd_(stop_fd),
      waiting_(std::move(waiting)),
      calls_(calls),
      is_device_(isDevice(config.frames)) {
  openAgain(now_ns());
}

void FrameInput::openAgain(std::int64_t now) {
  if (source_ || (tried_ns_ != 0 && (!is_device_ || now - tried_ns_ < kTryAgain_ns))) return;
  tried_ns_ = now;
  heard_ns_ = now;
  try {
    open();
    if (!said_.empty()) say(config_.frames + ": the camera is there again");
    said_.clear();
  } catch (const std::runtime_error& e) {
    say(e.what());
  }
}

void FrameInput::open() {
  if (is_device_) {
    source_ = std::make_unique<V4l2Camera>(
        config_.frames, size_, config_.realtime_clock ? CLOCK_REALTIME : CLOCK_MONOTONIC, calls_);
    return;
  }
  FileDescriptor file(config_.frames == "-"
                          ? ::dup(STDIN_FILENO)
                          : ::open(config_.frames.c_str(), O_RDONLY | O_NONBLOCK));
  struct stat status {};
  if (!file.isOpen() || ::fstat(file.get(), &status) != 0)
    throw std::runtime_error(config_.frames + ": cannot be read: " + std::strerror(errno));
  const bool every_frame = config_.every_frame || S_ISREG(status.st_mode);
  source_ = std::make_unique<FrameStream>(std::move(file), stop_fd_, size_, every_frame, waiting_);
}

FrameSource::Read FrameInput::read(Frame& frame) {
  const FrameSource::Read answer = source_->read(frame);
  if (answer == FrameSource::Read::kLost) {
    say(source_->fault());
    dropped_ += source_->dropped();
    source_.reset();
    tried_ns_ = now_ns();
  }
  if (answer == FrameSource::Read::kFrame) heard_ns_ = now_ns();
  return answer;
}

void FrameInput::closeSilent(std::int64_t now) {
  if (!source_ || !is_device_ || now - heard_ns_ < kSilent_ns) return;
  say(config_.frames + ": no image for a second; the camera is opened again each second");
  dropped_ += source_->dropped();
  source_.reset();
  tried_ns_ = now;
}

void FrameInput::say(const std::string& fault) {
  if (fault != said_) std::fprintf(stderr, "vslam_onboard: %s\n", fault.c_str());
  said_ = fault;
}

}  // namespace ardrone_vslam
