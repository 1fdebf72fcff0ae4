// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>

#include "ardrone_vslam/saved_map.hpp"

namespace ardrone_vslam {

/// The file that gets the flight's map in flight and at the end (`save_map`, `autosave_s`). What
/// has another thread than that of isDue() and keep() says so.
class KeptMap {
 public:
  /// @param path  empty: none
  /// @param made_by  of writeMap()
  KeptMap(std::string path, std::string made_by)
      : path_(std::move(path)), made_by_(std::move(made_by)), tried_(ros::SteadyTime::now()) {}

  /// Empty: none.
  const std::string& path() const { return path_; }
  /// How often in flight, first after 10 s at most; 0: only at the end. From any thread.
  void setPeriod(double period_s) { period_s_ = period_s; }
  /// Whether it should be kept now; if so, the next time begins.
  bool isDue();
  /// A map, told from the others since the start. From the mapper's thread.
  int number() const { return number_; }
  /// The map begins anew. From the mapper's thread.
  void beginAnew() { ++number_; }
  /// Writes what is new. What the file had of another map goes on as NAME.before.
  /// @param number  of the map, as it was when that was taken
  /// @throws MapFileError when it cannot
  void keep(MapSnapshot map, int number);

 private:
  std::string path_;
  std::string made_by_;
  std::atomic<double> period_s_{0};
  ros::SteadyTime tried_;
  std::atomic<int> number_{1};
  int kept_number_ = 0;       // of the map that the file has; 0: none of this run
  std::int64_t kept_ns_ = 0;  // SavedMap::stamp_ns of what it has of it
};

}  // namespace ardrone_vslam
