// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_all.hpp"

#include <algorithm>
#include <future>

namespace ardrone_vslam {
namespace {

/// Calls work(i) for i = 0 .. count - 1, spread over at most `threads` threads.
template <class Work>
void forEach(std::size_t count, int threads, const Work& work) {
  const std::size_t workers = std::min(count, static_cast<std::size_t>(threads));
  std::vector<std::future<void>> others;
  const auto share = [&](std::size_t worker) {
    for (std::size_t i = worker; i < count; i += workers) work(i);
  };
  for (std::size_t worker = 1; worker < workers; ++worker) {
    others.push_back(std::async(std::launch::async, share, worker));
  }
  share(0);
  for (auto& other : others) other.get();
}

}  // namespace

void BackEnds::add(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
                   const RunOdometry& odometry, const std::vector<RangeReading>& ranges,
                   const RunMaps& maps) {
  back_ends_.push_back(std::make_unique<BackEnd>(config, T_base_cam, odometry.run.states, ranges));
  if (maps.loaded) back_ends_.back()->load(*maps.loaded);
  if (maps.is_recorded) back_ends_.back()->record();
  are_maps_saved_ = maps.is_saved;
  scale_errors_.push_back(odometry.run.scale_error);
  are_late_.push_back(odometry.run.is_late);
}

double BackEnds::process(const TrackedFrame& frame) {
  std::vector<double> costs_ms(back_ends_.size(), 0.0);
  forEach(back_ends_.size(), threads_,
          [&](std::size_t i) { costs_ms[i] = back_ends_[i]->process(frame); });
  return costs_ms.empty() ? 0.0 : *std::max_element(costs_ms.begin(), costs_ms.end());
}

std::vector<RunResult> BackEnds::results(bool is_finished) const {
  std::vector<RunResult> results;
  for (std::size_t i = 0; i < back_ends_.size(); ++i) {
    results.push_back(back_ends_[i]->result(is_finished, are_maps_saved_ && is_finished));
    results.back().scale_error = scale_errors_[i];
    results.back().is_finished = is_finished;
    if (are_late_[i])  // an image's stamp is the truth's time of it, whatever the offset in use
      for (RunFrame& frame : results.back().frames) frame.image_time_offset_ns = 0;
  }
  return results;
}

std::vector<RunResult> runAll(Sequence& sequence, const PipelineConfig& config,
                              const std::vector<RunOdometry>& odometries, int threads,
                              const Progress& progress, const std::optional<ComputerSpeed>& speed,
                              const RunMaps& maps) {
  BackEnds back_ends(threads);
  for (const RunOdometry& odometry : odometries)
    back_ends.add(config.mapper, sequence.T_base_cam(), odometry, sequence.ranges(), maps);
  SlowComputer computer(speed.value_or(ComputerSpeed{}));
  NextImage next_image;
  double cost_ms = 0;
  if (speed) next_image = [&](std::size_t i) { return computer.next(sequence, i, cost_ms); };
  const auto results = [&](bool is_finished) {
    std::vector<RunResult> runs = back_ends.results(is_finished);
    for (RunResult& run : runs) {
      add(sequence.odometryInputFaults(), run.odometry_faults);
      run.frames_dropped_slow = computer.dropped();
    }
    return runs;
  };
  std::size_t done = 0;
  // The front end runs once for all seeds. With `use_attitude` it takes the first seed's: attitudes
  // of one profile differ by no more than the pattern's steps of 1.4 degrees.
  const FrontEndAttitude attitude{&odometries.front().run.states,
                                  config.mapper.image_time_offset_s};
  const auto consume = [&](const TrackedFrame& frame) {
    cost_ms = back_ends.process(frame);
    ++done;
    if (progress)
      progress(done + static_cast<std::size_t>(computer.dropped()), [&] { return results(false); });
  };
  runFrontEnd(sequence, config.tracker, attitude, threads, consume, next_image);
  return results(true);
}

}  // namespace ardrone_vslam
