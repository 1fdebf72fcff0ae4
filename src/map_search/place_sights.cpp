// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/place_sights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

// Sights agree when they put the newest image so close together: a share of the landmarks'
// distance, and what odometry may have drifted by since.
constexpr double kAgreeDistance = 0.1;
constexpr double kAgreeDrift = 0.1;  // of the way
constexpr double kAgreeHeading_rad = 0.09;

/// Of the sights that agree with the newest one.
struct Demands {
  std::size_t of_latest;  // looks, the newest one included
  int sights;
  double least_cover;  // of each of them
  double mean_cover;   // of all looks since the first of them, another place or none being 0; and
                       // of the newest
  double way;          // between the newest and some of them, of the landmarks' distance
};
constexpr Demands kHere{11, 3, 0.6, 0.6, 0};
// Two thirds of true sights pass, in a real kitchen and in rooms with the same furniture and
// posters (make_world's hotel); of sights of such a room in another one's map one in a hundred, but
// then several in a second.
constexpr Demands kAtOnce{11, 4, 0.75, 0.75, 0};
// A map that is bent is seldom recognised that well, but again and again as the camera goes on.
constexpr Demands kInTheLongRun{32, 20, 0.01, 0.5, 0.2};
constexpr std::size_t kRemembered = kInTheLongRun.of_latest;

bool agree(const PlaceSight& earlier, const PlaceSight& newest) {
  const Eigen::Isometry3d difference =
      newest.entry.T_loaded_flight * earlier.entry.T_loaded_flight.inverse();
  const Eigen::Vector3d position = earlier.entry.T_loaded_flight * newest.camera_flight;
  const double off_m = (difference * position - position).norm();
  const double displacement_m = (newest.camera_flight - earlier.camera_flight).norm();
  return off_m < kAgreeDistance * newest.distance_m + kAgreeDrift * displacement_m &&
         std::abs(headingOf(difference.linear())) < kAgreeHeading_rad;
}

bool meet(const Demands& demands, const std::vector<std::optional<PlaceSight>>& looks) {
  const std::optional<PlaceSight>& newest = looks.back();
  if (!newest || newest->cover < demands.mean_cover) return false;
  int good = 0;
  int since_first = 0;
  double sum_of_covers = 0;
  double way_m = 0;
  for (std::size_t i = looks.size() - std::min(demands.of_latest, looks.size()); i < looks.size();
       ++i) {
    const double cover = looks[i] && agree(*looks[i], *newest) ? looks[i]->cover : 0;
    if (cover >= demands.least_cover) {
      ++good;
      way_m = std::max(way_m, (looks[i]->camera_flight - newest->camera_flight).norm());
    }
    if (good == 0) continue;
    ++since_first;
    sum_of_covers += cover;
  }
  return good >= demands.sights && sum_of_covers >= demands.mean_cover * since_first &&
         way_m >= demands.way * newest->distance_m;
}

}  // namespace

double headingOf(const Eigen::Matrix3d& R) {
  return portable::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
}

bool PlaceSights::add(const std::optional<PlaceSight>& sight, bool is_here) {
  latest_.push_back(sight);
  if (latest_.size() > kRemembered) latest_.erase(latest_.begin());
  return meet(is_here ? kHere : kAtOnce, latest_) || meet(kInTheLongRun, latest_);
}

}  // namespace ardrone_vslam
