// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "linear/scalars.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

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
  /// Its last image, the first that shows something again.
  std::int64_t until_ns() const { return to_ns_; }
  /// Whether the landmarks of this anchor are from before.
  bool isAfter(const Clone& anchor) const {
    return from_ns_ != 0 && (anchor.is_loaded || anchor.stamp_ns < from_ns_);
  }
  /// Covariance of the way meanwhile: position, attitude. From the last pose before that is in the
  /// state, or from map's origin; to the first one after.
  Matrix6d drift(const WindowState& state) const {
    const auto& frames = state.frames();
    std::size_t after = 0;
    while (after + 1 < frames.size() && frames[after].stamp_ns < to_ns_) ++after;
    const int to = state.frameCoordinate(after);
    for (std::size_t i = after; i-- > 0;)
      if (frames[i].stamp_ns < from_ns_)
        return state.relativeCovariance(to, state.frameCoordinate(i));
    for (std::size_t i = state.anchors().size(); i-- > 0;)
      if (!state.anchors()[i].is_loaded && state.anchors()[i].stamp_ns < from_ns_)
        return state.relativeCovariance(to, state.anchorCoordinate(i));
    return state.covariance().block<6, 6>(to, to);
  }
  /// Landmarks from before, of which most agree. @param is_explained  by the covariance
  /// @return whether they may correct the pose
  bool judge(std::int64_t stamp_ns, bool is_explained) {
    constexpr double kSure_s = 3;  // wrong landmarks agree for some images
    constexpr double kGap_s = 1;
    if (!is_explained || agreed_from_ns_ == 0 || seconds(stamp_ns - agreed_ns_) > kGap_s)
      agreed_from_ns_ = is_explained ? stamp_ns : 0;
    agreed_ns_ = stamp_ns;
    const bool is_sure = is_explained && seconds(stamp_ns - agreed_from_ns_) > kSure_s;
    if (is_sure || seconds(stamp_ns - to_ns_) > kRevisitTakes_s) forget();
    return is_explained || from_ns_ == 0;
  }

 private:
  static constexpr double kRevisitTakes_s = 20;

  std::int64_t from_ns_ = 0;  // 0: there was none
  std::int64_t to_ns_ = 0;
  std::int64_t agreed_from_ns_ = 0;  // 0: they do not
  std::int64_t agreed_ns_ = 0;
};

}  // namespace ardrone_vslam
