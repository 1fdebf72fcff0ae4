// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ardrone_vslam {

/// A line on stderr that tells how far a long job is, at most five times a second on a terminal,
/// every ten percent elsewhere. The destructor ends the line.
class ProgressLine {
 public:
  ProgressLine(std::string title, std::size_t total);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(std::size_t done);

 private:
  std::string title_;
  std::size_t total_;
  bool terminal_;
  bool shown_ = false;
  std::int64_t started_ns_;
  std::int64_t last_shown_ns_ = 0;
  std::size_t last_tenth_ = 0;
};

}  // namespace ardrone_vslam
