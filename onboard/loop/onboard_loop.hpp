// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "input/frame_input.hpp"
#include "input/observer_input.hpp"
#include "input/observer_source.hpp"
#include "loop/answer_output.hpp"
#include "loop/cpu_share.hpp"
#include "loop/image_counts.hpp"
#include "loop/pose_pipeline.hpp"
#include "protocol/udp.hpp"
#include "settings/settings.hpp"

namespace ardrone_vslam {

/// The program: waits for images and records in one thread, answers each image, and says at least
/// every kSayState_ns how it is. Allocates nothing of its own after construction; when the core has
/// no memory left the map begins anew.
class OnboardLoop {
 public:
  static constexpr std::int64_t kSayState_ns = 200'000'000;

  /// @param stop_fd  becomes readable when the program is to stop
  /// @throws ConfigError, std::runtime_error, std::invalid_argument
  OnboardLoop(const Settings& settings, int stop_fd);

  /// Until it is to stop, or a file's images end. @return whether all went well: no source of
  /// images was lost for good
  bool run();

  /// UDP; for one that was given as 0.
  int observerPort() const { return portOf(observer_source_.descriptor()); }
  /// @copydoc FlightMap::saveAtEnd()
  std::string saveMap() { return pipeline_.saveAtEnd(); }
  /// What was answered, lost and dropped, and what it cost: a line each.
  void printSummary() const;

 private:
  bool waitForInput();
  bool step();
  void startOver();
  int timeout_ms(std::int64_t now) const;
  bool mayReadFrame(std::int64_t now) const;
  bool readFrame();
  void whileWaiting();
  void readObserver();
  void answer();
  void giveUp(std::uint32_t state);
  std::uint32_t idleState(std::int64_t now) const;
  void sayState(std::int64_t now);
  AnswerOutput::Counters counters() const;

  Settings settings_;
  int stop_fd_;
  PosePipeline pipeline_;
  ObserverSource observer_source_;
  ObserverInput observer_input_;
  AnswerOutput output_;
  FrameInput frames_;
  CpuShare share_;
  std::int64_t began_ns_;
  std::int64_t frame_ns_ = 0;  // when the newest image came; 0: none has
  std::int64_t said_ns_ = began_ns_;
  ImageCounts images_;
};

}  // namespace ardrone_vslam
