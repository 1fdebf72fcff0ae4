// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/landmark_upkeep.hpp"

#include <algorithm>
#include <cmath>

#include "linear/scalars.hpp"
#include "map_update/image_parts.hpp"

namespace ardrone_vslam {
namespace {

// A track's point is worth a landmark when it is known to this share of its distance.
constexpr double kLandmarkSigma = 0.2;

/// Of points seen along a baseline that the odometry's velocity error may have made (a drone that
/// turns on the spot, the camera at its nose): all of them are so much nearer or further, which
/// shows only from elsewhere.
Eigen::Matrix3d covarianceByStretch(double stretch_sigma, const Eigen::Vector3d& offset) {
  constexpr double kLittle = 0.1;
  constexpr double kCaution = 3;  // a velocity error is one draw for all of them
  if (stretch_sigma < kLittle) return Eigen::Matrix3d::Zero();
  return squared(kCaution * stretch_sigma) * offset * offset.transpose();
}

}  // namespace

Landmark landmarkOf(const UsedTrack& used, const FrameView& view) {
  Landmark landmark;
  const Eigen::Vector3d offset = used.point.position_map - view.origin_map();
  const Eigen::Matrix3d by_stretch = covarianceByStretch(used.stretch_sigma, offset);
  const double variance_m2 = used.point.covariance_m2.trace() + by_stretch.trace();
  landmark.position_map = used.point.position_map;
  landmark.covariance_m2 = used.covariance_m2 + by_stretch;
  landmark.anchor_id = used.anchor_id;
  landmark.sigma_m = static_cast<float>(std::sqrt(variance_m2 / 3));
  landmark.depth_sigma_m = static_cast<float>(std::sqrt(variance_m2));
  landmark.parallax_rad = static_cast<float>(used.point.parallax_rad);
  landmark.position_variance_m2 = static_cast<float>(view.positionVariance_m2());
  landmark.track_id = used.track.track_id;
  landmark.descriptor = used.track.descriptor;
  landmark.seen_distance_m = static_cast<float>(offset.norm());
  landmark.view_direction_map = offset.normalized().cast<float>();
  landmark.first_seen_ns = view.features().stamp_ns;
  landmark.last_seen_ns = view.features().stamp_ns;
  landmark.times_seen = static_cast<int>(used.track.views.size());
  return landmark;
}

bool isWellKnown(const UsedTrack& one, const FrameView& view) {
  const double distance_m = (one.point.position_map - view.origin_map()).norm();
  return std::sqrt(one.covariance_m2.trace()) < kLandmarkSigma * distance_m;
}

void renew(const UsedTrack& one, const FrameView& view, const MsckfConfig& config,
           const Landmark& landmark, LandmarkMap& map) {
  // Its place beside the old anchor is forgotten: the drift since then must be worth it, too, and
  // once it gives fixes it stays where it is.
  constexpr double kBetter = 0.5;  // in variance
  const double age_s = seconds(view.features().stamp_ns - landmark.first_seen_ns);
  if (age_s > config.fix_min_age_s) return;
  const double distance_m = (one.point.position_map - view.origin_map()).norm();
  const double drift_m =
      distance_m *
      view.driftAngle_rad(landmark.anchor_id, landmark.position_variance_m2, distance_m);
  if (one.covariance_m2.trace() + 3 * drift_m * drift_m > kBetter * landmark.covariance_m2.trace())
    return;
  Landmark better = landmarkOf(one, view);
  better.id = landmark.id;
  better.descriptor = landmark.descriptor;
  better.first_seen_ns = landmark.first_seen_ns;
  better.times_seen += landmark.times_seen;
  map.atPlace(map.indexOf(landmark.id)) = better;
}

void applyCorrections(const std::vector<AnchorCorrection>& corrections, const FrameView& view,
                      LandmarkMap& map) {
  if (corrections.empty()) return;
  // Most landmarks stay where they are and are not touched; their anchors lie close together in
  // the columns.
  const LandmarkColumns& columns = map.columns(view.origin_map());
  // Neighbours mostly belong to one anchor.
  std::uint32_t anchor_id = 0;
  auto correction = corrections.end();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::uint32_t its_anchor = columns.anchorId(i);
    if (its_anchor != anchor_id) {
      anchor_id = its_anchor;
      correction = std::find_if(
          corrections.begin(), corrections.end(),
          [anchor_id](const AnchorCorrection& one) { return one.anchor_id == anchor_id; });
    }
    if (correction != corrections.end()) correction->apply(map.atPlace(i));
  }
}

void followTracks(const FrameView& view, const std::vector<Association>& matches,
                  LandmarkMap& map) {
  for (const Association& match : matches) {
    map.atPlace(static_cast<std::size_t>(match.target)).track_id =
        view.features().track_id[static_cast<std::size_t>(match.feature)];
  }
}

std::vector<int> takeFailed(const AssociationResult& matches,
                            const std::vector<Association>& trusted,
                            const std::vector<ObservationVerdict>& verdicts, bool is_relocated,
                            const FrameView& view, LandmarkMap& map) {
  // Behind a wall none of a place's landmarks is found; where somebody hides it, none in that part.
  constexpr int kOneIn = 10;
  constexpr std::uint64_t kParts = kImageParts + 1;  // and none
  const auto placeOf = [&](int target) {
    const Landmark& landmark = map.all()[static_cast<std::size_t>(target)];
    return std::uint64_t{landmark.anchor_id} * kParts + partWith(landmark.position_map, view);
  };
  std::vector<std::uint64_t> found;  // the places, as often as landmarks of them were
  std::vector<std::uint64_t> missed;
  found.reserve(trusted.size());
  missed.reserve(matches.missed.size());
  for (const Association& match : trusted) found.push_back(placeOf(match.target));
  for (const int target : matches.missed) missed.push_back(placeOf(target));
  const std::vector<std::uint64_t> place_of_missed = missed;
  std::sort(found.begin(), found.end());
  std::sort(missed.begin(), missed.end());
  const auto countIn = [](const auto& sorted, std::uint64_t first, std::uint64_t last) {
    return std::upper_bound(sorted.begin(), sorted.end(), last) -
           std::lower_bound(sorted.begin(), sorted.end(), first);
  };
  const auto isInView = [&](std::uint64_t first, std::uint64_t last) {
    return (kOneIn - 1) * countIn(found, first, last) >= countIn(missed, first, last);
  };
  std::vector<int> failed;
  failed.reserve(matches.missed.size() + matches.matches.size());
  for (std::size_t i = 0; i < missed.size(); ++i) {
    const std::uint64_t place = place_of_missed[i];
    const std::uint64_t anchor = place - place % kParts;
    if (isInView(place, place) && isInView(anchor, anchor + kImageParts))
      failed.push_back(matches.missed[i]);
  }
  for (std::size_t i = 0; i < matches.matches.size(); ++i) {
    if (verdicts[i] != ObservationVerdict::kContradicts) continue;
    const int target = matches.matches[i].target;
    failed.push_back(target);
    // It was remembered, but not as an observation that speaks for it.
    if (!is_relocated) --map.atPlace(static_cast<std::size_t>(target)).times_seen;
  }
  return failed;
}

}  // namespace ardrone_vslam
