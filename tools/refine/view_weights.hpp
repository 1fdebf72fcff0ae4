// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "refine/track_points.hpp"

namespace ardrone_vslam {

/// How much each view counts, as a keyframe's views err together by `track_common_px`, however many
/// they are (TrackUpdate has the same of tracks).
class ViewWeights {
 public:
  /// @param record  must outlive this
  /// @param most_common_px  of `track_common_px`
  ViewWeights(const FlightRecord& record, const std::vector<TrackPoint3d>& points,
              double most_common_px)
      : record_(record),
        common_px_(std::min(record.config.track_common_px, most_common_px)),
        in_keyframe_(record.keyframes.size(), 0.0) {
    for (const TrackPoint3d& point : points) {
      for (const Sight& sight : point.sights) ++in_keyframe_[sight.keyframe];
    }
  }

  double of(const Sight& sight) const {
    const double common_rad = common_px_ / record_.keyframes[sight.keyframe].focal_length_px;
    const double common_sigmas = common_rad / sight.sigma_rad;
    return 1 / (1 + in_keyframe_[sight.keyframe] * common_sigmas * common_sigmas);
  }

 private:
  const FlightRecord& record_;
  double common_px_;
  std::vector<double> in_keyframe_;  // views
};

}  // namespace ardrone_vslam
