// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>
#include <algorithm>
#include <unordered_set>
#include <utility>

#include "ardrone_vslam/flight_record.hpp"
#include "linear/scalars.hpp"
#include "odometry/odometry_step.hpp"
#include "window/odometry_noise.hpp"

namespace ardrone_vslam {
namespace {

/// Of a feature's place along columns and rows, as the filter takes it [1/rad^2].
Eigen::Matrix2d informationOf(const ImageFeatures& features, std::size_t i,
                              const MsckfConfig& config) {
  const double focal_px = features.focal_length_px;
  Eigen::Matrix2d variance_px2 = squared(config.track_sigma_px) * Eigen::Matrix2d::Identity();
  if (!features.information.empty() && !features.information[i].empty()) {
    const PixelInformation& known = features.information[i];
    Eigen::Matrix2d information;
    information << known.xx_per_px2, known.xy_per_px2, known.xy_per_px2, known.yy_per_px2;
    variance_px2 = information.inverse();
    variance_px2.diagonal().array() += squared(config.track_scene_px);
  }
  return variance_px2.inverse() * squared(focal_px);
}

// With 64 bits. With 32 it is less, but every processor is to keep the same keyframes.
constexpr std::size_t kKeyframe_bytes = 528;
static_assert(sizeof(Keyframe) <= kKeyframe_bytes, "what is kept takes more than is counted");

}  // namespace

struct FlightRecorder::State {
  MsckfConfig config;
  bool is_planar = false;
  Eigen::Isometry3d T_base_cam;
  std::size_t most_bytes = 0;
  std::size_t bytes = 0;
  bool is_full = false;
  FlightRecord record;
  OdometryStepWatch steps;
  std::optional<OdometryState> last;
  double travelled_m = 0;
  std::optional<double> floor_odom_m;  // by the last height that the filter has used
  Keyframe next;                       // what has come together since the last one

  void follow(const OdometryState& odometry) {
    const std::optional<OdometryStep> step = steps.see(odometry);
    if (!last) {
      next.T_odom_base = odometry.T_odom_base;
      travelled_m = odometry.T_odom_base.translation().norm();  // at least
    } else {
      const Eigen::Vector3d way =
          step ? step->motion_odom_m
               : odometry.T_odom_base.translation() - last->T_odom_base.translation();
      next.T_odom_base.translation() += way;
      next.T_odom_base.linear() = odometry.T_odom_base.linear();
      next.way_variance_m2 +=
          walkVariance_m2(config.odometry, *last, odometry, way.norm(), travelled_m);
      if (step)
        next.way_variance_m2 += step->jump_odom_m.squaredNorm() + squared(step->motion_sigma_m);
      next.way_m += way.norm();
      travelled_m += way.norm();
    }
    last = odometry;
  }

  /// Each that the filter has used counts once, at the next keyframe.
  void takeHeight(const OdometryState& odometry, HeightOutcome outcome) {
    if (outcome == HeightOutcome::kNone) return;
    if (outcome == HeightOutcome::kNewFloor) ++next.floor;
    floor_odom_m.reset();
    const std::optional<double> height_m =
        is_planar ? std::optional<double>(0) : odometry.height_m;  // as the estimator has it
    if (outcome != HeightOutcome::kRejected && height_m)
      floor_odom_m = next.T_odom_base.translation().z() - *height_m;
  }

  /// The filter's keyframes lie closer together than a whole flight needs them.
  bool isWorthKeeping(const ImageFeatures& features) const {
    constexpr double kGoOn = 0.3;  // of the last one's tracks
    constexpr double kLongest_s = 1;
    if (features.size() == 0) return false;
    if (record.keyframes.empty()) return true;
    const Keyframe& before = record.keyframes.back();
    if (seconds(features.stamp_ns - before.stamp_ns) > kLongest_s) return true;
    const std::unordered_set<std::uint32_t> now(features.track_id.begin(), features.track_id.end());
    const auto common =
        std::count_if(before.views.begin(), before.views.end(),
                      [&now](const KeyframeView& view) { return now.count(view.track_id) > 0; });
    return static_cast<double>(common) < kGoOn * static_cast<double>(before.views.size());
  }

  void addViews(const ImageFeatures& features) {
    for (std::size_t i = 0; i < features.size(); ++i) {
      // Half of the new ones are not seen again. The first keyframe has no others, and is where the
      // map begins.
      if (features.age_frames[i] == 0 && !record.keyframes.empty()) continue;
      const Eigen::Matrix2f information_rad2 = informationOf(features, i, config).cast<float>();
      if (!(information_rad2.determinant() > 0)) continue;  // nothing is known along an edge
      next.views.push_back({features.track_id[i], features.bearing_cam[i], information_rad2});
    }
  }

  /// From then on it stays as it is: later frames that fit would be far apart.
  bool isFullWith(const ImageFeatures& features, const Landmarks& landmarks) {
    const std::size_t most = bytes + kKeyframe_bytes + features.size() * sizeof(KeyframeView) +
                             landmarks.size() * sizeof(LandmarkTrack);
    is_full = is_full || most > most_bytes;
    return is_full;
  }

  void pass(std::int64_t stamp_ns) {
    if (record.keyframes.empty()) return;
    next.passed.push_back({stamp_ns, next.T_odom_base});
    bytes += sizeof(PassedFrame);
  }

  void addLandmarks(const Landmarks& landmarks) {
    const std::int64_t since_ns = record.keyframes.empty() ? 0 : record.keyframes.back().stamp_ns;
    for (const Landmark& landmark : landmarks) {
      if (landmark.last_seen_ns > since_ns)
        next.landmarks.push_back({landmark.track_id, landmark.id});
    }
  }

  /// Begins what lies between it and the one after.
  void keep() {
    record.keyframes.push_back(next);
    bytes += kKeyframe_bytes + next.views.size() * sizeof(KeyframeView) +
             next.landmarks.size() * sizeof(LandmarkTrack);
    next.views.clear();
    next.landmarks.clear();
    next.passed.clear();
    next.height_m.reset();
    floor_odom_m.reset();
    next.way_variance_m2 = 0;
    next.way_m = 0;
  }
};

FlightRecorder::FlightRecorder(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
                               std::size_t most_bytes)
    : state_(std::make_unique<State>()) {
  state_->config = config.msckf;
  state_->is_planar = config.planar;
  state_->T_base_cam = T_base_cam;
  state_->most_bytes = most_bytes;
  state_->record.config = config.msckf;
}

FlightRecorder::~FlightRecorder() = default;

void FlightRecorder::useCamera(const Eigen::Isometry3d& T_base_cam) {
  state_->T_base_cam = T_base_cam;
}

void FlightRecorder::see(const ImageFeatures& features, const OdometryState& odometry,
                         const FrameResult& result, const Landmarks& landmarks) {
  State& s = *state_;
  if (s.steps.isNewStart(odometry) || result.state == SlamState::kSearchingMap ||
      result.state == SlamState::kNotFinite || result.revisit_m > 0) {
    s.record = {};
    s.record.is_whole = false;
  }
  if (!s.record.is_whole || s.is_full) return;
  s.follow(odometry);
  s.takeHeight(odometry, result.height);
  if (!result.is_keyframe) return;
  if (s.isFullWith(features, landmarks)) return;
  if (!s.isWorthKeeping(features)) {
    s.pass(features.stamp_ns);
    return;
  }
  s.next.stamp_ns = features.stamp_ns;
  s.next.T_map_base = result.T_map_base;
  s.next.T_base_cam = s.T_base_cam;
  s.next.focal_length_px = features.focal_length_px;
  if (s.floor_odom_m) s.next.height_m = s.next.T_odom_base.translation().z() - *s.floor_odom_m;
  s.addViews(features);
  s.addLandmarks(landmarks);
  s.keep();
  OdometryNoiseConfig& noise = s.record.config.odometry;
  noise.velocity_bias_m_s = result.velocity_bias_sigma_m_s;
  noise.yaw_walk_deg_per_sqrt_s =
      s.config.odometry.yaw_walk_deg_per_sqrt_s * result.yaw_walk_factor;
  noise.yaw_walk_deg_per_sqrt_m =
      s.config.odometry.yaw_walk_deg_per_sqrt_m * result.yaw_walk_factor;
}

const FlightRecord& FlightRecorder::record() const {
  return state_->record;
}

FlightRecord FlightRecorder::take() {
  return std::move(state_->record);
}

}  // namespace ardrone_vslam
