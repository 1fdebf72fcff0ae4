// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "linear/scalars.hpp"
#include "map_update/map_fix.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// What landmarks from before a blind stretch say.
enum class AcrossBlind {
  kAsUsual,      ///< the covariance explains it, or there was no such stretch of late
  kWidened,      ///< the odometry erred meanwhile by more than it claims: now that is in the state
  kContradicts,  ///< not even that explains it
};

/// Since when the camera may be elsewhere than its odometry says: hardly a track led from one image
/// to the next, as when it is carried with the lens covered. Landmarks from before then correct no
/// more than what odometry may have erred by meanwhile, for a while. A larger correction would bend
/// the way before, too. RevisitSearch tells where the camera is now, and moves all that was made
/// since.
class BlindStretch {
 public:
  /// Hardly a track leads to this image.
  void note(std::int64_t stamp_ns) {
    if (from_ns_ == 0 || seconds(stamp_ns - to_ns_) > kRevisitTakes_s) from_ns_ = stamp_ns;
    to_ns_ = stamp_ns;
    agreed_from_ns_ = 0;
  }
  /// Where the camera is now is known.
  void forget() { *this = BlindStretch(); }
  /// Whether the landmarks of this anchor are from before.
  bool isAfter(const Clone& anchor) const {
    return from_ns_ != 0 && (anchor.is_loaded || anchor.stamp_ns < from_ns_);
  }
  /// What a fix by these landmarks says, most of which may be from before; widens the state.
  AcrossBlind judge(const MapFix& fix, const std::vector<MapObservation>& seen, WindowState& state);
  /// Landmarks from before, of which most agree. @param is_explained  by the covariance
  /// @return whether they may correct the pose
  bool judge(std::int64_t stamp_ns, bool is_explained);

 private:
  static constexpr double kRevisitTakes_s = 20;

  Matrix6d drift(const WindowState& state) const;

  std::int64_t from_ns_ = 0;         // 0: there was none
  std::int64_t to_ns_ = 0;           // its last image, the first that shows something again
  std::int64_t agreed_from_ns_ = 0;  // 0: they do not
  std::int64_t agreed_ns_ = 0;
};

}  // namespace ardrone_vslam
