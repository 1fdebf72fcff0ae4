// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/revisit_search.hpp"

#include <algorithm>
#include <sstream>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kBetweenLooks_ns = kSecond_ns;
constexpr std::int64_t kBetweenSights_ns = kSecond_ns / 5;  // as long as MapSearch waits
// Landmarks that were seen so lately are of this visit: they show where the camera is thought to
// be, right or wrong.
constexpr std::int64_t kThisVisit_ns = 5 * kSecond_ns;
// Of an image: as many as tell a place, but no more, as it is looked for all along.
constexpr std::size_t kMostFeatures = 250;

/// Where the camera is thought to be already.
bool isHere(const PlaceSight& sight) {
  PlaceSight here;
  here.camera_flight = sight.camera_flight;
  return agree(here, sight);
}

}  // namespace

std::string explainRevisit(double revisit_m) {
  std::ostringstream text;
  text.precision(2);
  text << "found in its map " << revisit_m
       << " m from where it was thought to be, and moved there: the drone was carried while its "
          "camera "
          "was covered, or the odometry errs by far more than it claims";
  return text.str();
}

void RevisitSearch::beginAnew(std::int64_t stamp_ns) {
  located_ns_ = lost_ns_ = stamp_ns;
  next_look_ns_ = stamp_ns + kBetweenLooks_ns;
  fewest_tracks_ = std::numeric_limits<std::size_t>::max();
  sights_.clear();
}

std::optional<Revisit> RevisitSearch::see(const ImageFeatures& features, SlamState before,
                                          const Eigen::Isometry3d& T_map_cam, LandmarkMap& map) {
  const std::int64_t now_ns = features.stamp_ns;
  const bool is_located = before == SlamState::kLocalised || before == SlamState::kRelocated;
  if (is_located || located_ns_ == 0) {  // the first image has no tracks
    beginAnew(now_ns);
  } else if (features.tracked() <= fewest_tracks_) {
    fewest_tracks_ = features.tracked();
    lost_ns_ = now_ns;
  }
  if (now_ns < next_look_ns_ || before == SlamState::kDistrusted ||
      static_cast<int>(features.size()) < kFewestFeatures)
    return std::nullopt;

  const LookLimits limits{wasCovered() ? lost_ns_ : now_ns - kThisVisit_ns, kMostFeatures};
  std::optional<PlaceSight> sight = look_.at(features, T_map_cam, map, limits);
  next_look_ns_ = now_ns + (sight ? kBetweenSights_ns : kBetweenLooks_ns);
  if (sight && isHere(*sight)) sight.reset();
  if (!sights_.add(sight)) return std::nullopt;
  Revisit revisit;
  revisit.entry = sight->entry;
  revisit.anchor_id = sight->anchor_id;
  revisit.from_ns = wasCovered() ? lost_ns_ : std::max(located_ns_, sight->last_seen_ns);
  revisit.to_ns = wasCovered() ? lost_ns_ : now_ns;
  beginAnew(now_ns);
  return revisit;
}

}  // namespace ardrone_vslam
