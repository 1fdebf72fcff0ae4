// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_seen_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "doctor/recording/doctor_stamps.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kApart_ns = 220'000'000;       // a pair's images, at least
constexpr std::int64_t kTooFar_ns = 700'000'000;      // at most: tracks and odometry would be old
constexpr std::int64_t kLongestGap_ns = 500'000'000;  // of the odometry about an image
constexpr std::size_t kFewestTracks = 15;
constexpr double kFewestMoving_px = 3;  // median of the tracks: less tells nothing
constexpr double kNearest_m = 0.3;

const OdometryState* firstFrom(const std::vector<OdometryState>& odometry, std::int64_t stamp_ns) {
  const auto at = std::lower_bound(
      odometry.begin(), odometry.end(), stamp_ns,
      [](const OdometryState& state, std::int64_t ns) { return state.stamp_ns < ns; });
  return at == odometry.end() ? nullptr : &*at;
}

std::optional<Eigen::Isometry3d> poseAt(const std::vector<OdometryState>& odometry,
                                        std::int64_t stamp_ns) {
  const OdometryState* after = firstFrom(odometry, stamp_ns);
  if (after == nullptr) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->T_odom_base;
  if (after == odometry.data()) return std::nullopt;
  const OdometryState* before = after - 1;
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
  std::vector<double> moved;
  for (const auto& track : pair.tracks) moved.push_back((track.now - track.before).norm());
  return medianOf(std::move(moved)) * pair.focal_length_px;
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
    const Eigen::Vector3d nearing = -(R_cam_before * motion.displacement_before_m);
    double tracks_px = 0;
    for (const auto& track : motion.images->tracks) {
      const double off_rad = residual_rad(R_now_before * track.before, nearing, track.now);
      tracks_px += std::min(off_rad * motion.images->focal_length_px, cut_px);
    }
    sum_px += tracks_px / static_cast<double>(motion.images->tracks.size());
  }
  return sum_px / static_cast<double>(std::max<std::size_t>(1, motions.size()));
}

}  // namespace ardrone_vslam
