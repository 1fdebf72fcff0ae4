// SPDX-License-Identifier: BSD-3-Clause
#include "doctor_mounting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kApart_ns = 220'000'000;       // a pair's images, at least
constexpr std::int64_t kTooFar_ns = 700'000'000;      // at most: tracks and odometry would be old
constexpr std::int64_t kLongestGap_ns = 500'000'000;  // of the odometry about an image
constexpr std::size_t kFewestTracks = 15;
constexpr double kFewestMoving_px = 3;  // median of the tracks: less tells nothing
constexpr double kNearest_m = 0.3;
constexpr std::size_t kFewestMotions = 10;
constexpr double kCoarse_px = 40;    // cut of the residuals while turns by 90 degrees are compared
constexpr double kFine_px = 8;       // and for the rest
constexpr double kOther_rad = 0.6;   // further apart than this are two mountings, not one
constexpr double kClearly = 1.3;     // times as bad, and
constexpr double kClearly_px = 0.4;  // so much worse is a rival that is none
constexpr double kAgrees = 0.6;      // share of what it is without any motion

const ObserverState* firstFrom(const std::vector<ObserverState>& odometry, std::int64_t stamp_ns) {
  const auto at = std::lower_bound(
      odometry.begin(), odometry.end(), stamp_ns,
      [](const ObserverState& state, std::int64_t ns) { return state.stamp_ns < ns; });
  return at == odometry.end() ? nullptr : &*at;
}

std::optional<Eigen::Isometry3d> poseAt(const std::vector<ObserverState>& odometry,
                                        std::int64_t stamp_ns) {
  const ObserverState* after = firstFrom(odometry, stamp_ns);
  if (after == nullptr) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->T_odom_base;
  if (after == odometry.data()) return std::nullopt;
  const ObserverState* before = after - 1;
  if (after->stamp_ns - before->stamp_ns > kLongestGap_ns) return std::nullopt;
  return interpolate(*before, *after, stamp_ns).T_odom_base;
}

using Ray = std::pair<std::uint32_t, Eigen::Vector3d>;

std::vector<Ray> raysOf(const ImageFeatures& features) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < features.size(); ++i) {
    rays.emplace_back(features.track_id[i], features.bearing_cam[i].cast<double>());
  }
  std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.first < b.first; });
  return rays;
}

std::vector<SeenMotion::Track> common(const std::vector<Ray>& before, const std::vector<Ray>& now) {
  std::vector<SeenMotion::Track> tracks;
  auto old = before.begin();
  for (const Ray& ray : now) {
    while (old != before.end() && old->first < ray.first) ++old;
    if (old == before.end()) break;
    if (old->first == ray.first) tracks.push_back({old->second, ray.second});
  }
  return tracks;
}

double medianMotion_px(const SeenMotion& motion) {
  std::vector<double> ways;
  for (const auto& track : motion.tracks) ways.push_back((track.now - track.before).norm());
  const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
  std::nth_element(ways.begin(), middle, ways.end());
  return *middle * motion.focal_length_px;
}

/// How far `seen` is from the way that a point at bearing `far` takes when it comes nearer, in
/// radians: from where it is seen at infinity along `nearing` (per inverse metre of depth).
double residual_rad(const Eigen::Vector3d& far, const Eigen::Vector3d& nearing,
                    const Eigen::Vector3d& seen) {
  constexpr double kInFront = 0.2;  // cosine; further off the tangent plane is no measure
  const double cosine = far.dot(seen);
  if (cosine < kInFront) return 2;
  // In the tangent plane at `seen` a great circle is a straight line.
  const Eigen::Vector3d begin = far / cosine - seen;
  double nearest = 1 / kNearest_m;
  const double slope = nearing.dot(seen);
  if (cosine + nearest * slope < kInFront) nearest = (kInFront - cosine) / slope;
  const Eigen::Vector3d end = (far + nearest * nearing) / (cosine + nearest * slope) - seen;
  const Eigen::Vector3d line = end - begin;
  const double length2 = line.squaredNorm();
  const double along = length2 > 1e-18 ? std::clamp(-begin.dot(line) / length2, 0.0, 1.0) : 0.0;
  return (begin + along * line).norm();
}

/// Turns that take axes to axes.
std::vector<Eigen::Matrix3d> quarterTurns() {
  std::vector<Eigen::Matrix3d> turns;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Eigen::Matrix3d R;
      R.col(0) = Eigen::Vector3d::Unit(x % 3) * (x < 3 ? 1 : -1);
      R.col(1) = Eigen::Vector3d::Unit(y % 3) * (y < 3 ? 1 : -1);
      R.col(2) = R.col(0).cross(R.col(1));
      turns.push_back(R);
    }
  }
  return turns;
}

double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

/// Pattern search about the camera's axes, from steps of 16 degrees down to an eighth of one.
Eigen::Matrix3d refined(const std::vector<SeenMotion>& motions, Eigen::Matrix3d R, double cut_px) {
  constexpr double kFirst_rad = 16 * M_PI / 180, kLast_rad = 0.1 * M_PI / 180;
  double best_px = misfit_px(motions, R, cut_px);
  for (double step_rad = kFirst_rad; step_rad > kLast_rad;) {
    bool is_better = false;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d turn = Eigen::Vector3d::Unit(i % 3) * (i < 3 ? step_rad : -step_rad);
      const Eigen::Matrix3d turned = R * rotationOf(turn);
      const double turned_px = misfit_px(motions, turned, cut_px);
      if (turned_px >= best_px) continue;
      best_px = turned_px;
      R = turned;
      is_better = true;
    }
    if (!is_better) step_rad /= 2;
  }
  return R;
}

std::vector<SeenMotion> everyOther(const std::vector<SeenMotion>& motions, std::size_t first) {
  std::vector<SeenMotion> half;
  for (std::size_t i = first; i < motions.size(); i += 2) half.push_back(motions[i]);
  return half;
}

}  // namespace

std::vector<SeenMotion> seenMotions(const std::vector<ImageFeatures>& images,
                                    const std::vector<ObserverState>& odometry,
                                    const Eigen::Vector3d& lever_base_m, double offset_s) {
  std::vector<SeenMotion> motions;
  const auto offset_ns = static_cast<std::int64_t>(std::llround(offset_s * 1e9));
  std::size_t before = 0;
  for (std::size_t now = 1; now < images.size(); ++now) {
    const std::int64_t passed_ns = images[now].stamp_ns - images[before].stamp_ns;
    if (passed_ns < kApart_ns) continue;
    const auto T_odom_before = poseAt(odometry, images[before].stamp_ns + offset_ns);
    const auto T_odom_now = poseAt(odometry, images[now].stamp_ns + offset_ns);
    SeenMotion motion;
    if (passed_ns <= kTooFar_ns && T_odom_before && T_odom_now) {
      const Eigen::Isometry3d T_before_now = T_odom_before->inverse() * *T_odom_now;
      motion.R_before_now = T_before_now.linear();
      motion.way_before_m = T_before_now * lever_base_m - lever_base_m;
      motion.focal_length_px = images[now].focal_length_px;
      motion.tracks = common(raysOf(images[before]), raysOf(images[now]));
    }
    before = now;
    if (motion.tracks.size() < kFewestTracks) continue;
    if (medianMotion_px(motion) >= kFewestMoving_px) motions.push_back(std::move(motion));
  }
  return motions;
}

double misfit_px(const std::vector<SeenMotion>& motions, const Eigen::Matrix3d& R_base_cam,
                 double cut_px) {
  double sum_px = 0;
  for (const SeenMotion& motion : motions) {
    const Eigen::Matrix3d R_cam_before = R_base_cam.transpose() * motion.R_before_now.transpose();
    const Eigen::Matrix3d R_now_before = R_cam_before * R_base_cam;
    const Eigen::Vector3d nearing = -(R_cam_before * motion.way_before_m);
    double tracks_px = 0;
    for (const auto& track : motion.tracks) {
      const double off_rad = residual_rad(R_now_before * track.before, nearing, track.now);
      tracks_px += std::min(off_rad * motion.focal_length_px, cut_px);
    }
    sum_px += tracks_px / static_cast<double>(motion.tracks.size());
  }
  return sum_px / static_cast<double>(std::max<std::size_t>(1, motions.size()));
}

MountingEstimate estimateMounting(const std::vector<SeenMotion>& motions,
                                  const Eigen::Matrix3d& R_base_cam_told) {
  MountingEstimate estimate;
  estimate.R_base_cam = R_base_cam_told;
  estimate.motions = motions.size();
  if (motions.size() < kFewestMotions) return estimate;

  struct Candidate {
    double misfit_px;
    Eigen::Matrix3d R_base_cam;
  };
  std::vector<Candidate> candidates;
  for (const Eigen::Matrix3d& turn : quarterTurns()) {
    const Eigen::Matrix3d R = R_base_cam_told * turn;
    candidates.push_back({misfit_px(motions, R, kCoarse_px), R});
  }
  const auto isBetter = [](const Candidate& a, const Candidate& b) {
    return a.misfit_px < b.misfit_px;
  };
  std::sort(candidates.begin(), candidates.end(), isBetter);
  constexpr std::size_t kRefined = 5;
  candidates.resize(kRefined);
  for (Candidate& candidate : candidates) {
    candidate.R_base_cam = refined(motions, candidate.R_base_cam, kCoarse_px);
    candidate.R_base_cam = refined(motions, candidate.R_base_cam, kFine_px);
    candidate.misfit_px = misfit_px(motions, candidate.R_base_cam, kFine_px);
  }
  std::sort(candidates.begin(), candidates.end(), isBetter);
  const Candidate& best = candidates.front();
  estimate.R_base_cam = best.R_base_cam;
  estimate.misfit_px = best.misfit_px;
  estimate.misfit_told_px = misfit_px(motions, R_base_cam_told, kFine_px);
  estimate.off_rad = angleBetween(best.R_base_cam, R_base_cam_told);
  estimate.misfit_rival_px = kFine_px;
  for (const Candidate& candidate : candidates) {
    if (angleBetween(candidate.R_base_cam, best.R_base_cam) < kOther_rad) continue;
    estimate.misfit_rival_px = std::min(estimate.misfit_rival_px, candidate.misfit_px);
  }
  estimate.unsure_rad = angleBetween(refined(everyOther(motions, 0), best.R_base_cam, kFine_px),
                                     refined(everyOther(motions, 1), best.R_base_cam, kFine_px));
  const bool is_clear = estimate.misfit_rival_px > kClearly * estimate.misfit_px &&
                        estimate.misfit_rival_px > estimate.misfit_px + kClearly_px;
  estimate.state = estimate.misfit_px > kAgrees * kFine_px ? MountingState::kNoAgreement
                   : !is_clear                             ? MountingState::kAmbiguous
                                                           : MountingState::kFound;
  return estimate;
}

}  // namespace ardrone_vslam
