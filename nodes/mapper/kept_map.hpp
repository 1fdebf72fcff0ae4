// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>

#include "ardrone_vslam/saved_map.hpp"

namespace ardrone_vslam {

/// Of map files.
constexpr char kMadeByMapper[] = "mapper " ARDRONE_VSLAM_VERSION;

/// The file that gets the flight's map in flight and at the end (`save_map`, `autosave_s`). What
/// another thread than that of isDue() and keep() may call says so.
class KeptMap {
 public:
  /// @param path  empty: none
  explicit KeptMap(std::string path) : path_(std::move(path)), tried_(ros::SteadyTime::now()) {}

  /// Empty: none.
  const std::string& path() const { return path_; }
  /// How often in flight, first after 10 s at most; 0: only at the end. From any thread.
  void setPeriod(double period_s) { period_s_ = period_s; }
  /// Whether it should be kept now; if so, the next time begins.
  bool isDue();
  /// Writes what is new in the map. @throws std::exception when it cannot
  void keep(MapSnapshot map);
  /// The map begins anew: the file goes on as NAME.before. From any thread.
  void beginAnew() { kept_ns_ = 0; }

 private:
  std::string path_;
  std::atomic<double> period_s_{0};
  ros::SteadyTime tried_;
  std::atomic<std::int64_t> kept_ns_{0};  // SavedMap::stamp_ns of what it has of this map
};

}  // namespace ardrone_vslam
