// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/revisit_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "ardrone_vslam/frame_result.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kBetweenLooks_ns = kSecond_ns;
constexpr std::int64_t kBetweenSights_ns = kSecond_ns / 5;  // as long as MapSearch waits
// Landmarks that are younger are of this visit: they show where the camera is thought to be, right
// or wrong.
constexpr std::int64_t kEarlierVisit_ns = 20 * kSecond_ns;
// Nor are those looked for that were seen so lately.
constexpr std::int64_t kOutOfView_ns = 5 * kSecond_ns;
// Where it was put down wrong landmarks may agree for some images.
constexpr std::int64_t kSure_ns = 3 * kSecond_ns;
// Of an image: as many as tell a place, but no more, as it is looked for all along.
constexpr std::size_t kMostFeatures = 250;
// What a sight errs by beside its covariance: the map is bent.
constexpr double kBent = 0.02;  // of the landmarks' distance, and of the heading [rad]
constexpr double kSigmas = 3;   // of a sight that says another place
// A camera that was not covered has seen its way: no odometry errs by more.
constexpr double kMostDrift = 0.3;  // of the way
constexpr double kMostTurn_rad = M_PI / 3;

}  // namespace

std::string explainRevisit(double revisit_m) {
  std::ostringstream text;
  text.precision(2);
  text << "found in its map " << revisit_m
       << " m from where it was thought to be, or turned, and moved there: the drone was carried "
          "while its camera was covered, or the odometry errs by far more than it claims";
  return text.str();
}

void RevisitSearch::beginAnew(std::int64_t stamp_ns) {
  located_ns_ = stamp_ns;
  next_look_ns_ = stamp_ns + kBetweenLooks_ns;
  covered_from_ns_ = covered_to_ns_ = 0;
  way_m_ = 0;
  sights_.clear();
}

void RevisitSearch::noteShift(std::int64_t stamp_ns, const Revisit& revisit) {
  beginAnew(stamp_ns);
  last_camera_map_ = revisit.entry.camera_loaded;
}

void RevisitSearch::follow(const ImageFeatures& features, const Eigen::Vector3d& camera_map,
                           bool has_map) {
  if (last_camera_map_) way_m_ += (camera_map - *last_camera_map_).norm();
  last_camera_map_ = camera_map;
  const std::int64_t now_ns = features.stamp_ns;
  const std::int64_t visit_ns = wasCovered() ? covered_from_ns_ : now_ns - kEarlierVisit_ns;
  const bool is_first = located_ns_ == 0;  // it has no tracks
  const bool has_looked = std::exchange(has_looked_, false);
  const bool is_known = known_since_ns_ && *known_since_ns_ < visit_ns;
  if (has_looked && (!is_known || known_from_ns_ == 0)) known_from_ns_ = is_known ? now_ns : 0;
  const bool is_sure =
      has_looked && is_known && (!wasCovered() || now_ns - known_from_ns_ > kSure_ns);
  if (is_first || is_sure) beginAnew(now_ns);
  const bool has_tracks = static_cast<int>(features.tracked()) >= kFewestFeatures;
  if (is_first || !has_map || has_tracks || is_another_camera_) return;
  if (!wasCovered()) covered_from_ns_ = now_ns;
  covered_to_ns_ = now_ns;
}

bool RevisitSearch::isElsewhere(const PlaceSight& sight) const {
  const double turn_rad = headingOf(sight.entry.T_loaded_flight.linear());
  Eigen::Vector4d off;
  off << sight.entry.camera_loaded - sight.camera_flight, turn_rad;
  Eigen::Matrix4d covariance = sight.entry.covariance;
  covariance.diagonal().head<3>().array() += squared(kBent * sight.distance_m);
  covariance(3, 3) += squared(kBent);
  if (off.dot(covariance.inverse() * off) < squared(kSigmas)) return false;
  return isCarry(sight) ||
         (off.head<3>().norm() < kMostDrift * way_m_ && std::abs(turn_rad) < kMostTurn_rad);
}

std::optional<Revisit> RevisitSearch::see(const ImageFeatures& features, bool is_trusted,
                                          const Eigen::Isometry3d& T_map_cam, LandmarkMap& map,
                                          FrameBudget& budget) {
  const std::int64_t now_ns = features.stamp_ns;
  follow(features, T_map_cam.translation(), static_cast<int>(map.size()) >= kFewestFixLandmarks);
  is_another_camera_ = false;
  if (now_ns < next_look_ns_ || !is_trusted ||
      static_cast<int>(features.size()) < kFewestFeatures ||
      !budget.take(OptionalWork::kPlaceSearch))
    return std::nullopt;

  const LookLimits limits{std::max(covered_from_ns_, now_ns - kOutOfView_ns), kMostFeatures};
  std::optional<PlaceSight> sight = look_.at(features, T_map_cam, map, limits);
  budget.done(OptionalWork::kPlaceSearch);
  if (sight && !isElsewhere(*sight)) sight.reset();
  next_look_ns_ = now_ns + (sight ? kBetweenSights_ns : kBetweenLooks_ns);
  if (!sights_.add(sight)) return std::nullopt;
  Revisit revisit;
  revisit.entry = sight->entry;
  revisit.anchor_id = sight->anchor_id;
  const bool is_carry = isCarry(*sight);
  revisit.from_ns = is_carry ? covered_from_ns_ : std::max(located_ns_, sight->last_seen_ns);
  revisit.to_ns = is_carry ? covered_to_ns_ : now_ns;
  return revisit;
}

}  // namespace ardrone_vslam
