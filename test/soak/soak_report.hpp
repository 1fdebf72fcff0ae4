// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ardrone_vslam/frame_result.hpp"
#include "soak/process_state.hpp"

namespace ardrone_vslam::test {

/// Of the frames of an interval [ms].
struct FrameTimes {
  double median = 0;
  double of_99_percent = 0;
  double of_99_9_percent = 0;
  double largest = 0;

  /// Reorders the values.
  static FrameTimes of(std::vector<float>& values_ms);
};

/// What was measured over one interval, at its end.
struct SoakRow {
  double flown_h = 0;
  std::uint64_t images = 0;  ///< of the interval
  ProcessState process;
  int landmarks = 0;
  double features = 0;  ///< mean of an image
  FrameTimes cpu;       ///< processor time of the thread: other programs do not count
  FrameTimes wall;
  double error_rms_m = 0;  ///< of the position against the truth
  double error_largest_m = 0;
  double nees_per_axis = 0;                             ///< of the position, over 3: 1 is honest
  std::array<double, kSlamStateNames.size()> shares{};  ///< of the states
};

/// Sums of an interval. The memory is taken once.
class SoakInterval {
 public:
  explicit SoakInterval(std::uint64_t images);

  void add(const FrameResult& result, const Eigen::Isometry3d& T_map_base, double cpu_ms,
           double wall_ms);
  std::uint64_t images() const { return cpu_ms_.size(); }
  /// And begins the next one.
  SoakRow finish(double flown_h);

 private:
  std::vector<float> cpu_ms_;
  std::vector<float> wall_ms_;
  SoakRow sums_;
};

/// The bounds that a soak must keep. The first quarter of the rows is the warm-up, the next row the
/// reference; errors are compared between the halves of what follows the warm-up.
struct SoakBounds {
  double heap_mb = 1;                       ///< growth beside the map's
  double resident_mb = 4;                   ///< likewise
  double per_landmark_mb = 0.002;           ///< what one more landmark may take
  double error_ratio = 1.5;                 ///< of later errors to earlier ones
  double error_more_m = 0.05;               ///< and this
  double nees_more = 0.5;                   ///< likewise
  static constexpr std::size_t kLeast = 5;  ///< rows without which there is no verdict
};

/// What is not flat, a sentence each; empty: all is.
std::vector<std::string> faultsOf(const std::vector<SoakRow>& rows, const SoakBounds& bounds);

/// For people: a header and a line.
std::string headerLine();
std::string lineOf(const SoakRow& row);
/// All rows and faults.
std::string jsonOf(const std::vector<SoakRow>& rows, const std::vector<std::string>& faults);

}  // namespace ardrone_vslam::test
