// SPDX-License-Identifier: BSD-3-Clause
#include "loop/onboard_loop.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>

#include "protocol/clocks.hpp"
#include "yaml/calibration.hpp"

namespace ardrone_vslam {
namespace {

FrameSize sizeOf(const CameraIntrinsics& camera, bool halve) {
  return {camera.width_px, camera.height_px, halve};
}

std::int64_t cpu_ns() {
  return clock_ns(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace

OnboardLoop::OnboardLoop(const Settings& settings, int stop_fd)
    : settings_(settings),
      stop_fd_(stop_fd),
      pipeline_(settings.tracker, settings.mapper, readCalibration(settings.onboard.camera),
                extrinsicsOf(settings.onboard),
                {settings.map_file, settings.save_map, settings.autosave_s,
                 settings.mapper.msckf.localise_only}),
      observer_source_(settings.onboard, stop_fd),
      output_(settings.onboard),
      frames_(settings.onboard,
              sizeOf(pipeline_.cameraModel().intrinsics(), settings.onboard.halve), stop_fd,
              [this] { whileWaiting(); }),
      share_(settings.onboard.cpu_share),
      began_ns_(now_ns()) {}

bool OnboardLoop::run() {
  bool goes_on = true;
  while (goes_on && waitForInput()) {
    try {
      goes_on = step();
    } catch (const std::bad_alloc&) {
      startOver();
    }
  }
  output_.sendState(frames_.isOver() ? VSLAM_CAMERA_LOST : VSLAM_ENDING, 0, counters());
  return !frames_.isOver();
}

/// @return false when the program is to stop
bool OnboardLoop::step() {
  if (observer_source_.isLive()) readObserver();
  frames_.closeSilent(now_ns());
  if (pipeline_.isWaiting()) {
    answer();
  } else if (frames_.isLost()) {
    frames_.openAgain(now_ns());
    if (frames_.isOver()) return false;
  } else if (mayReadFrame(now_ns()) && frames_.hasMore() && !readFrame()) {
    return false;
  }
  sayState(now_ns());
  return true;
}

/// Without the map there is memory again.
void OnboardLoop::startOver() {
  ++images_.out_of_memory;
  pipeline_.startOverEmpty();
  share_.end(cpu_ns());
  output_.sendState(VSLAM_OUT_OF_MEMORY, pipeline_.features().stamp_ns, counters());
  said_ns_ = now_ns();
}

/// @return false when the program is to stop
bool OnboardLoop::waitForInput() {
  const std::int64_t now = now_ns();
  const bool wants_observer =
      !pipeline_.observer().isOver() && (observer_source_.isLive() || pipeline_.isWaiting());
  const auto entry = [](int fd, bool is_wanted) { return pollfd{is_wanted ? fd : -1, POLLIN, 0}; };
  std::array<pollfd, 3> entries{entry(stop_fd_, true),
                                entry(observer_source_.descriptor(), wants_observer),
                                entry(frames_.descriptor(), mayReadFrame(now))};
  ::poll(entries.data(), entries.size(), timeout_ms(now));
  return entries[0].revents == 0;
}

bool OnboardLoop::mayReadFrame(std::int64_t now) const {
  return !pipeline_.isWaiting() && now >= share_.next_ns();
}

int OnboardLoop::timeout_ms(std::int64_t now) const {
  constexpr std::int64_t kMillisecond_ns = 1'000'000;
  if (mayReadFrame(now) && frames_.isBuffered()) return 0;
  std::int64_t until_ns = now + kSayState_ns / 2;
  if (pipeline_.isWaiting()) {
    // The answer's last moment; a file's end needs no waiting.
    const auto wait_ns = static_cast<std::int64_t>(settings_.odometry_wait_s * 1e9);
    until_ns = pipeline_.observer().isOver() ? now : std::min(until_ns, frame_ns_ + wait_ns);
  } else if (share_.next_ns() > now) {
    until_ns = std::min(until_ns, share_.next_ns());
  }
  return static_cast<int>(
      std::max<std::int64_t>(0, (until_ns - now + kMillisecond_ns - 1) / kMillisecond_ns));
}

/// @return false at the end of the images
bool OnboardLoop::readFrame() {
  Frame frame;
  share_.begin(now_ns(), cpu_ns());
  const FrameSource::Read read = frames_.read(frame);
  if (read == FrameSource::Read::kEnd) return false;
  if (read != FrameSource::Read::kFrame) return true;
  frame_ns_ = now_ns();
  if (pipeline_.track(frame)) {
    answer();
  } else {
    ++images_.stamps_refused;
  }
  share_.end(cpu_ns());
  return true;
}

/// An image has begun to come and does not go on.
void OnboardLoop::whileWaiting() {
  if (observer_source_.isLive()) readObserver();
  sayState(now_ns());
}

void OnboardLoop::readObserver() {
  const std::uint8_t* record = nullptr;
  std::size_t size = 0;
  while (true) {
    const ObserverSource::Read read = observer_source_.read(record, size);
    if (read == ObserverSource::Read::kNone) return;
    if (read == ObserverSource::Read::kEnd) {
      pipeline_.observer().end();
      return;
    }
    const auto state = observer_input_.read(record, size, now_ns());
    if (state && !pipeline_.observer().add(*state)) observer_input_.countRefused();
    if (!observer_source_.isLive()) return;  // a file's states only as they are needed
  }
}

/// Answers the waiting image, if its observer is there or can never come.
void OnboardLoop::answer() {
  PosePipeline::Answer answer = pipeline_.localise();
  while (answer == PosePipeline::Answer::kNotYet && !observer_source_.isLive() &&
         !pipeline_.observer().isOver() && observer_source_.hasMore()) {
    readObserver();
    answer = pipeline_.localise();
  }
  const std::int64_t now = now_ns();
  if (answer == PosePipeline::Answer::kNotYet) {
    if (static_cast<double>(now - frame_ns_) < settings_.odometry_wait_s * 1e9) return;
    return giveUp(idleState(now));
  }
  if (answer == PosePipeline::Answer::kNever) return giveUp(idleState(now));
  images_.answer(share_.end(cpu_ns()));
  said_ns_ = now;
  const FrameResult& result = pipeline_.result();
  if (isFinite(result)) {
    output_.sendPose(result, counters());
  } else {
    output_.sendState(VSLAM_NOT_FINITE, result.stamp_ns, counters());
  }
  output_.saySetup(pipeline_.setup());
  output_.sendTelemetry(pipeline_.features(), pipeline_.landmarks(), now);
  pipeline_.saveInFlight(now);
}

void OnboardLoop::giveUp(std::uint32_t state) {
  pipeline_.forgetFrame();
  ++images_.without_odometry;
  output_.sendState(state, pipeline_.features().stamp_ns, counters());
  said_ns_ = now_ns();
}

/// Why there is no pose.
std::uint32_t OnboardLoop::idleState(std::int64_t now) const {
  const std::int64_t since_ns = now - std::max(frame_ns_, began_ns_);
  if (frames_.isLost() || since_ns > FrameInput::kSilent_ns) return VSLAM_CAMERA_LOST;
  if (observer_input_.isSilent(now, settings_.onboard.controller_silent_s))
    return VSLAM_CONTROLLER_SILENT;
  return frame_ns_ == 0 ? VSLAM_WAITING_FOR_IMAGES : VSLAM_NO_OBSERVER;
}

void OnboardLoop::sayState(std::int64_t now) {
  if (now - said_ns_ < kSayState_ns) return;
  std::uint32_t state = idleState(now);
  // Images come, slowly.
  if (state == VSLAM_NO_OBSERVER && !pipeline_.isWaiting()) state = VSLAM_WAITING_FOR_IMAGES;
  said_ns_ = now;
  output_.sendState(state, 0, counters());
}

AnswerOutput::Counters OnboardLoop::counters() const {
  return {frames_.dropped() + images_.lost(), observer_input_.counts().dropped(),
          static_cast<std::uint32_t>(pipeline_.landmarks().size())};
}

void OnboardLoop::printSummary() const {
  const ObserverInput::Counts& records = observer_input_.counts();
  std::fprintf(
      stderr,
      "vslam_onboard: %u images answered, %u without observer, %u with bad stamps, %u made "
      "way for newer ones, %u times out of memory; %u records, dropped: %u of a wrong size, %u of "
      "a wrong kind, %u corrupted, %u old, %u refused; %zu landmarks, %d restarts\n",
      images_.answered, images_.without_odometry, images_.stamps_refused, frames_.dropped(),
      images_.out_of_memory, records.accepted, records.wrong_size, records.wrong_kind,
      records.corrupted, records.old, records.refused, pipeline_.landmarks().size(),
      pipeline_.restarts());
  if (images_.answered == 0) return;
  std::fprintf(stderr, "vslam_onboard: %.2f ms of processor time an image, at most %.2f\n",
               static_cast<double>(images_.all_cost_ns) / 1e6 / images_.answered,
               static_cast<double>(images_.most_cost_ns) / 1e6);
}

}  // namespace ardrone_vslam
