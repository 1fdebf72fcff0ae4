// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "config_files/config_file.hpp"
#include "run/offline_run.hpp"
#include "run/run_odometry.hpp"
#include "run/slow_computer.hpp"
#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// Several back ends that get the same features.
class BackEnds {
 public:
  /// @param threads  over which they are spread; the results do not depend on it
  explicit BackEnds(int threads) : threads_(threads) {}
  /// @param odometry  must outlive this
  void add(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
           const RunOdometry& odometry, const std::vector<RangeReading>& ranges = {},
           const RunMaps& maps = {});
  /// @return what the image has cost where it cost most [ms]
  double process(const TrackedFrame& frame);
  /// In the order of add(). @param is_finished  no frame will follow: maps go along
  std::vector<RunResult> results(bool is_finished) const;

 private:
  int threads_;
  bool are_maps_saved_ = false;
  std::vector<std::unique_ptr<BackEnd>> back_ends_;
  std::vector<double> scale_errors_;
  std::vector<bool> are_late_;
};

/// The sequence with each of the odometries; the front end runs once for all.
/// @param threads  for decoding and for the odometries; the results do not depend on it
/// @param speed  of the computer that is emulated; nothing: it has time for all images
std::vector<RunResult> runAll(Sequence& sequence, const PipelineConfig& config,
                              const std::vector<RunOdometry>& odometries, int threads,
                              const Progress& progress,
                              const std::optional<ComputerSpeed>& speed = {},
                              const RunMaps& maps = {});

}  // namespace ardrone_vslam
