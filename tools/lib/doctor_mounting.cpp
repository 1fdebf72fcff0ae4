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
constexpr double kLargestOffset_s = 0.3;
constexpr double kOffsetStep_s = 0.04;
constexpr double kAgrees = 0.6;  // share of what it is without any motion

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

std::vector<ImagePair::Track> common(const std::vector<Ray>& before, const std::vector<Ray>& now) {
  std::vector<ImagePair::Track> tracks;
  auto old = before.begin();
  for (const Ray& ray : now) {
    while (old != before.end() && old->first < ray.first) ++old;
    if (old == before.end()) break;
    if (old->first == ray.first) tracks.push_back({old->second, ray.second});
  }
  return tracks;
}

double medianMotion_px(const ImagePair& pair) {
  std::vector<double> ways;
  for (const auto& track : pair.tracks) ways.push_back((track.now - track.before).norm());
  const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
  std::nth_element(ways.begin(), middle, ways.end());
  return *middle * pair.focal_length_px;
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

std::vector<ImagePair> everyOther(const std::vector<ImagePair>& pairs, std::size_t first) {
  std::vector<ImagePair> half;
  for (std::size_t i = first; i < pairs.size(); i += 2) half.push_back(pairs[i]);
  return half;
}

/// A rotation and an offset, and how well the images fit them.
struct Candidate {
  double misfit_px;
  Eigen::Matrix3d R_base_cam;
  double offset_s;
  bool operator<(const Candidate& other) const { return misfit_px < other.misfit_px; }
};

/// The offset about `candidate`'s that fits best, to a millisecond.
Candidate withBestOffset(const std::vector<ImagePair>& pairs, const OdometryWitness& odometry,
                         const Candidate& candidate) {
  Candidate best = candidate;
  best.misfit_px = misfit_px(odometry.motions(pairs, best.offset_s), best.R_base_cam, kFine_px);
  for (double step_s = kOffsetStep_s / 2; step_s > 0.0005;) {
    bool is_better = false;
    for (const double offset_s : {best.offset_s - step_s, best.offset_s + step_s}) {
      if (std::abs(offset_s) > kLargestOffset_s) continue;
      const double moved_px =
          misfit_px(odometry.motions(pairs, offset_s), best.R_base_cam, kFine_px);
      if (moved_px >= best.misfit_px) continue;
      best = {moved_px, best.R_base_cam, offset_s};
      is_better = true;
    }
    if (!is_better) step_s /= 2;
  }
  return best;
}

Candidate refined(const std::vector<ImagePair>& pairs, const OdometryWitness& odometry,
                  Candidate candidate) {
  for (const double cut_px : {kCoarse_px, kFine_px}) {
    const auto motions = odometry.motions(pairs, candidate.offset_s);
    candidate.R_base_cam = refined(motions, candidate.R_base_cam, cut_px);
    candidate = withBestOffset(pairs, odometry, candidate);
  }
  const auto motions = odometry.motions(pairs, candidate.offset_s);
  candidate.R_base_cam = refined(motions, candidate.R_base_cam, kFine_px);
  candidate.misfit_px = misfit_px(motions, candidate.R_base_cam, kFine_px);
  return candidate;
}

/// All mountings by quarter turns, each at the offset that suits it best; best first.
std::vector<Candidate> coarseCandidates(const std::vector<ImagePair>& pairs,
                                        const OdometryWitness& odometry,
                                        const Eigen::Matrix3d& R_base_cam_told) {
  const std::vector<Eigen::Matrix3d> turns = quarterTurns();
  std::vector<Candidate> candidates;
  for (const Eigen::Matrix3d& turn : turns) {
    candidates.push_back({2 * kCoarse_px, R_base_cam_told * turn, 0});
  }
  const auto steps = static_cast<int>(std::lround(kLargestOffset_s / kOffsetStep_s));
  for (int i = -steps; i <= steps; ++i) {
    const double offset_s = i * kOffsetStep_s;
    const auto motions = odometry.motions(pairs, offset_s);
    if (motions.size() < kFewestMotions) continue;
    for (Candidate& candidate : candidates) {
      const double moved_px = misfit_px(motions, candidate.R_base_cam, kCoarse_px);
      if (moved_px >= candidate.misfit_px) continue;
      candidate.misfit_px = moved_px;
      candidate.offset_s = offset_s;
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

/// The best ones, refined, until some are others than the best; best first.
std::vector<Candidate> refinedCandidates(const std::vector<ImagePair>& pairs,
                                         const OdometryWitness& odometry,
                                         const Eigen::Matrix3d& R_base_cam_told) {
  constexpr int kRivals = 3;
  std::vector<Candidate> candidates;
  int rivals = 0;
  for (const Candidate& coarse : coarseCandidates(pairs, odometry, R_base_cam_told)) {
    candidates.push_back(refined(pairs, odometry, coarse));
    const Eigen::Matrix3d& R_first = candidates.front().R_base_cam;
    rivals += angleBetween(candidates.back().R_base_cam, R_first) < kOther_rad ? 0 : 1;
    if (rivals == kRivals) break;
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

}  // namespace

std::vector<ImagePair> movingPairs(const std::vector<ImageFeatures>& images) {
  std::vector<ImagePair> pairs;
  std::size_t before = 0;
  for (std::size_t now = 1; now < images.size(); ++now) {
    const std::int64_t passed_ns = images[now].stamp_ns - images[before].stamp_ns;
    if (passed_ns < kApart_ns) continue;
    if (passed_ns <= kTooFar_ns) {
      ImagePair pair{images[before].stamp_ns, images[now].stamp_ns, images[now].focal_length_px,
                     common(raysOf(images[before]), raysOf(images[now]))};
      const bool is_telling =
          pair.tracks.size() >= kFewestTracks && medianMotion_px(pair) >= kFewestMoving_px;
      if (is_telling) pairs.push_back(std::move(pair));
    }
    before = now;
  }
  return pairs;
}

std::vector<SeenMotion> OdometryWitness::motions(const std::vector<ImagePair>& pairs,
                                                 double offset_s) const {
  std::vector<SeenMotion> motions;
  const auto offset_ns = static_cast<std::int64_t>(std::llround(offset_s * 1e9));
  for (const ImagePair& pair : pairs) {
    const auto T_odom_before = poseAt(states, pair.before_ns + offset_ns);
    const auto T_odom_now = poseAt(states, pair.now_ns + offset_ns);
    if (!T_odom_before || !T_odom_now) continue;
    const Eigen::Isometry3d T_before_now = T_odom_before->inverse() * *T_odom_now;
    motions.push_back({&pair, T_before_now.linear(), T_before_now * lever_base_m - lever_base_m});
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
    for (const auto& track : motion.images->tracks) {
      const double off_rad = residual_rad(R_now_before * track.before, nearing, track.now);
      tracks_px += std::min(off_rad * motion.images->focal_length_px, cut_px);
    }
    sum_px += tracks_px / static_cast<double>(motion.images->tracks.size());
  }
  return sum_px / static_cast<double>(std::max<std::size_t>(1, motions.size()));
}

MountingEstimate estimateMounting(const std::vector<ImagePair>& pairs,
                                  const OdometryWitness& odometry,
                                  const Eigen::Matrix3d& R_base_cam_told) {
  MountingEstimate estimate;
  estimate.R_base_cam = R_base_cam_told;
  estimate.motions = odometry.motions(pairs, 0).size();
  if (estimate.motions < kFewestMotions) return estimate;

  const std::vector<Candidate> candidates = refinedCandidates(pairs, odometry, R_base_cam_told);
  const Candidate& best = candidates.front();
  estimate.R_base_cam = best.R_base_cam;
  estimate.misfit_px = best.misfit_px;
  estimate.offset_s = best.offset_s;
  estimate.misfit_told_px =
      misfit_px(odometry.motions(pairs, best.offset_s), R_base_cam_told, kFine_px);
  estimate.misfit_unmoved_px = misfit_px(odometry.motions(pairs, 0), best.R_base_cam, kFine_px);
  estimate.off_rad = angleBetween(best.R_base_cam, R_base_cam_told);
  estimate.misfit_rival_px = kFine_px;
  for (const Candidate& candidate : candidates) {
    if (angleBetween(candidate.R_base_cam, best.R_base_cam) < kOther_rad) continue;
    estimate.misfit_rival_px = std::min(estimate.misfit_rival_px, candidate.misfit_px);
  }
  const Candidate even = refined(everyOther(pairs, 0), odometry, best);
  const Candidate odd = refined(everyOther(pairs, 1), odometry, best);
  estimate.unsure_rad = angleBetween(even.R_base_cam, odd.R_base_cam);
  const bool is_clear = estimate.misfit_rival_px > kClearly * estimate.misfit_px &&
                        estimate.misfit_rival_px > estimate.misfit_px + kClearly_px;
  estimate.state = estimate.misfit_px > kAgrees * kFine_px ? MountingState::kNoAgreement
                   : !is_clear                             ? MountingState::kAmbiguous
                                                           : MountingState::kFound;
  return estimate;
}

}  // namespace ardrone_vslam
