// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "ardrone_vslam/setup_watch.hpp"
#include "map/landmark_map.hpp"

namespace ardrone_vslam {

/// Takes landmarks back: what was made of images that a wrong set-up explains is wrong as well.
class UnconfirmedLandmarks {
 public:
  /// What is known of the set-up at the next frame.
  void heed(const SetupFinding& finding) { setup_ = finding; }
  /// While the camera is not used, drops those since it was last confirmed. @return how many went
  int judge(LandmarkMap& map);
  /// A new landmark, made of the image of this stamp.
  void add(std::int64_t stamp_ns) { newest_ns_ = stamp_ns; }
  /// A landmark of a loaded map, which this flight's set-up did not make. Their ids follow each
  /// other.
  void addLoaded(std::uint32_t id) {
    if (first_loaded_id_ == 0) first_loaded_id_ = id;
    last_loaded_id_ = id;
  }

 private:
  bool isLoaded(std::uint32_t id) const {
    return first_loaded_id_ != 0 && id >= first_loaded_id_ && id <= last_loaded_id_;
  }
  SetupFinding setup_;
  std::uint32_t first_loaded_id_ = 0;  // 0: none
  std::uint32_t last_loaded_id_ = 0;
  std::int64_t newest_ns_ = 0;     // a landmark's image: ids come round
  std::int64_t confirmed_ns_ = 0;  // the newest when the set-up was last confirmed
};

}  // namespace ardrone_vslam
