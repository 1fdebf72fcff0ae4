// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// The tracks of one image beside the odometry.
struct ComparedTracks {
  int tracks = 0;          ///< that had parallax enough; most images have none
  int agreed = 0;          ///< of these
  double travelled_m = 0;  ///< by the odometry, so far
};

/// Tells odometry that most tracks contradict, image after image, from wrong matches and from
/// odometry that is bad for a moment.
class ContraryTracks {
 public:
  /// One image; stamps ascending. O(1).
  void see(std::int64_t stamp_ns, const ComparedTracks& compared);
  /// For how long hardly a track has agreed, in five images or more; 0: some do.
  double lasted_s() const { return contrary_.images < kFewestToEnd ? 0 : contrary_.lasted_s; }
  /// Whether less than half of the last image's tracks agreed.
  bool isDoubtful() const { return doubtful_.images > 0; }
  /// The way since it is doubtful, if so many images say so that it is no chance; else 0. Where
  /// nothing is compared it grows for 5 s.
  double doubtfulWay_m() const;

 private:
  static constexpr int kFewestToEnd = 5;  // images
  /// Images, one after the other, of which too few tracks agree.
  struct Streak {
    int images = 0;
    std::int64_t last_ns = 0;
    double from_m = 0;  // ComparedTracks::travelled_m of the first
    double to_m = 0;    // and of the last, or soon after it
    double lasted_s = 0;
  };

  Streak contrary_;
  Streak doubtful_;
  double travelled_m_ = 0;
};

}  // namespace ardrone_vslam
