// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "support/heap_in_use.hpp"

namespace ardrone_vslam::test {

/// What this process has of the system.
struct ProcessState {
  double resident_mb = 0;
  double heap_mb = 0;  ///< that the program holds; not what malloc keeps for later
  int handles = 0;
  int threads = 0;

  static ProcessState now() {
    namespace fs = std::filesystem;
    constexpr double kBytesPerMb = 1e6;
    const auto countOf = [](const char* folder) {
      return static_cast<int>(std::distance(fs::directory_iterator(folder), {}));
    };
    ProcessState state;
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;  // the second number
    state.resident_mb = static_cast<double>(pages * sysconf(_SC_PAGESIZE)) / kBytesPerMb;
    state.heap_mb = static_cast<double>(heapInUse_bytes()) / kBytesPerMb;
    state.handles = countOf("/proc/self/fd") - 1;  // that of the count itself
    state.threads = countOf("/proc/self/task");
    return state;
  }
};

}  // namespace ardrone_vslam::test
