// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>

namespace ardrone_vslam::bench {

constexpr std::size_t kWarmUpSteps = 1;

/// One side of a row: `row`/`who`, where `who` is "ours" or the peer's name; the report pairs the
/// two sides.
/// @param setup  called before each repetition; gives the step to be timed, which is called with a
///   counter that goes up by one and returns how many things (corners, keypoints, queries) it did
/// @param share  what the report shows beside the time, 0..1: recall, share of corners; may be
///   empty
/// @return for settings of this side alone
template <class Setup>
benchmark::internal::Benchmark* side(const std::string& row, const std::string& who, Setup setup,
                                     const std::function<double()>& share = {}) {
  return benchmark::RegisterBenchmark((row + "/" + who).c_str(),
                                      [setup, share](benchmark::State& state) {
                                        auto step = setup();
                                        std::size_t i = 0;
                                        while (i < kWarmUpSteps) step(i++);
                                        std::size_t items = 0;
                                        for (auto _ : state) items += step(i++);
                                        state.SetItemsProcessed(static_cast<std::int64_t>(items));
                                        if (share) state.counters["share"] = share();
                                      });
}

}  // namespace ardrone_vslam::bench
