// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/contrary_tracks.hpp"

#include <algorithm>
#include <utility>

#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kFewestTracks = 8;
// Shares of tracks that agree. More than the first are left where two fifths of all matches are
// wrong. Below the second a harsh drone's odometry stays for 0.7 s, a car's at 2.5 Hz for 2.4 s.
constexpr double kContrary = 0.25;
constexpr double kDoubtful = 0.5;
constexpr int kFewestImages = 3;
constexpr double kMostBetween_s = 2;
constexpr double kLongestDoubt_s = 5;  // after the last image that says so
constexpr double kFrozen_m = 1e-9;     // of a stream that is frozen OdometryStepWatch knows

}  // namespace

void ContraryTracks::see(std::int64_t stamp_ns, const ComparedTracks& compared) {
  const double way_m = compared.travelled_m - std::exchange(travelled_m_, compared.travelled_m);
  if (seconds(stamp_ns - doubtful_.last_ns) < kLongestDoubt_s) doubtful_.to_m = travelled_m_;
  if (way_m < kFrozen_m || compared.tracks < kFewestTracks) return;
  const auto count = [&](double share, Streak& streak) {
    if (compared.agreed >= share * compared.tracks) {
      streak = {};
      return;
    }
    if (streak.images++ == 0) {
      streak.last_ns = stamp_ns;
      streak.from_m = travelled_m_;
    }
    // A rest between two images is not to count.
    streak.lasted_s += std::min(seconds(stamp_ns - streak.last_ns), kMostBetween_s);
    streak.last_ns = stamp_ns;
  };
  count(kContrary, contrary_);
  count(kDoubtful, doubtful_);
}

double ContraryTracks::doubtfulWay_m() const {
  return doubtful_.images < kFewestImages ? 0 : doubtful_.to_m - doubtful_.from_m;
}

}  // namespace ardrone_vslam
