// SPDX-License-Identifier: BSD-3-Clause
#include "program/progress_line.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kInterval_ns = 200'000'000;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

ProgressLine::ProgressLine(std::string title, std::size_t total)
    : title_(std::move(title)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      started_ns_(now_ns()) {}

ProgressLine::~ProgressLine() {
  if (shown_ && terminal_) std::fputc('\n', stderr);
}

void ProgressLine::update(std::size_t done) {
  const std::int64_t now = now_ns();
  const std::size_t tenth = total_ > 0 ? done * 10 / total_ : 0;
  const bool due =
      terminal_ ? now - last_shown_ns_ >= kInterval_ns || done == total_ : tenth > last_tenth_;
  if (!due) return;
  last_shown_ns_ = now;
  last_tenth_ = tenth;
  shown_ = true;
  const double seconds = static_cast<double>(now - started_ns_) * 1e-9;
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  std::fprintf(stderr, "%s%s: %zu / %zu (%.0f a second)%s", terminal_ ? "\r" : "", title_.c_str(),
               done, total_, rate, terminal_ ? "   " : "\n");
}

}  // namespace ardrone_vslam
