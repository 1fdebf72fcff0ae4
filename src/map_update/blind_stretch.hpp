// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "linear/scalars.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// Since when the camera may be elsewhere than its odometry says: hardly a track led from one image
/// to the next, as when it is carried with the lens covered. Landmarks from before then correct no
/// more than what odometry may have erred by since, for a while. A larger correction would bend the
/// way before, too. RevisitSearch tells where the camera is now, and moves all that was made since.
class BlindStretch {
 public:
  /// Hardly a track leads to this image.
  void note(std::int64_t stamp_ns) {
    if (from_ns_ == 0) from_ns_ = stamp_ns;
    to_ns_ = stamp_ns;
    agreed_from_ns_ = 0;
  }
  /// Where the camera is now is known.
  void forget() { *this = BlindStretch(); }
  /// Its last image.
  std::int64_t until_ns() const { return to_ns_; }
  /// Whether the landmarks of this anchor are from before.
  bool isAfter(const Clone& anchor) const {
    return from_ns_ != 0 && (anchor.is_loaded || anchor.stamp_ns < from_ns_);
  }
  /// Covariance of the way from the last pose before to the newest one: position, attitude. Of all
  /// that is known where none of before is in the state any more.
  Matrix6d driftSince(const WindowState& state) const {
    const int newest = state.frameCoordinate(state.frames().size() - 1);
    const auto is_before = [this](const Clone& pose) {
      return !pose.is_loaded && pose.stamp_ns < from_ns_;
    };
    for (std::size_t i = state.frames().size(); i-- > 0;)
      if (is_before(state.frames()[i]))
        return state.relativeCovariance(newest, state.frameCoordinate(i));
    for (std::size_t i = state.anchors().size(); i-- > 0;)
      if (is_before(state.anchors()[i]))
        return state.relativeCovariance(newest, state.anchorCoordinate(i));
    return state.covariance().block<6, 6>(newest, newest);
  }
  /// Landmarks from before, of which most agree. @param is_explained  by the covariance
  /// @return whether they may correct the pose
  bool judge(std::int64_t stamp_ns, bool is_explained) {
    constexpr double kSure_s = 3;  // wrong landmarks agree for some images
    constexpr double kRevisitTakes_s = 20;
    if (!is_explained) agreed_from_ns_ = 0;
    if (is_explained && agreed_from_ns_ == 0) agreed_from_ns_ = stamp_ns;
    const bool is_sure = is_explained && seconds(stamp_ns - agreed_from_ns_) > kSure_s;
    if (is_sure || seconds(stamp_ns - to_ns_) > kRevisitTakes_s) forget();
    return is_explained || from_ns_ == 0;
  }

 private:
  std::int64_t from_ns_ = 0;  // 0: there was none
  std::int64_t to_ns_ = 0;
  std::int64_t agreed_from_ns_ = 0;
};

}  // namespace ardrone_vslam
