// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/flight_section.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kPose = 96;  // bytes
constexpr std::size_t kView = 28;
constexpr std::size_t kLandmark = 8;
constexpr std::size_t kPassed = 8 + kPose;
constexpr std::size_t kKeyframe = 8 + 3 * kPose + 4 * 8 + 5 * 4;  // without what there are many of
constexpr std::size_t kPositive = 6;                              // of the numbers below

/// What a refinement needs of the configuration.
template <class Config>
auto noiseOf(Config& c) {
  return std::array{&c.odometry.scale_sigma,
                    &c.odometry.attitude_noise_deg,
                    &c.odometry.tilt_time_s,
                    &c.odometry.velocity_bias_time_s,
                    &c.track_sigma_px,
                    &c.height.height_sigma_m,
                    &c.odometry.tilt_sigma_deg,
                    &c.odometry.velocity_bias_m_s,
                    &c.odometry.yaw_walk_deg_per_sqrt_s,
                    &c.odometry.yaw_walk_deg_per_sqrt_m,
                    &c.track_common_px};
}

constexpr std::size_t kNoise =
    4 + 8 * std::tuple_size_v<decltype(noiseOf(std::declval<MsckfConfig&>()))>;

/// Behind the keyframes, where it is not 0: files of earlier versions end there.
constexpr std::size_t kExtrinsics = 8;

bool isAmount(double value) {
  return std::isfinite(value) && value >= 0;
}

bool isView(const KeyframeView& view) {
  constexpr float kTolerance = 1e-4F;
  const Eigen::Matrix2f& information = view.information_rad2;
  return view.bearing_cam.allFinite() &&
         std::abs(view.bearing_cam.squaredNorm() - 1) < kTolerance && information.allFinite() &&
         information(0, 0) > 0 && information.determinant() > 0;
}

/// @param before_ns  stamp of what comes before it
std::string passedFault(const Keyframe& keyframe, std::int64_t before_ns) {
  for (const PassedFrame& frame : keyframe.passed) {
    if (frame.stamp_ns <= before_ns || frame.stamp_ns >= keyframe.stamp_ns)
      return "was passed by frames that do not follow each other";
    const std::string fault = poseFault(frame.T_odom_base);
    if (!fault.empty()) return "was passed by a frame that " + fault;
    before_ns = frame.stamp_ns;
  }
  return {};
}

std::string keyframeFault(const Keyframe& k, const Keyframe* before) {
  constexpr int kMostFloors = 100'000;
  if (k.stamp_ns <= (before == nullptr ? -1 : before->stamp_ns))
    return "does not follow the one before";
  for (const Eigen::Isometry3d* pose : {&k.T_map_base, &k.T_odom_base, &k.T_base_cam}) {
    std::string fault = poseFault(*pose);
    if (!fault.empty()) return fault;
  }
  if (!std::isfinite(k.focal_length_px) || k.focal_length_px <= 0)
    return "has a focal length that is not positive";
  if (!isAmount(k.way_variance_m2) || !isAmount(k.way_m))
    return "has a way that is negative or not finite";
  if (!std::isfinite(k.height_m.value_or(0))) return "has a height that is not finite";
  if (k.floor < (before == nullptr ? 0 : before->floor) || k.floor > kMostFloors)
    return "is above a floor that cannot be";
  if (!std::all_of(k.views.begin(), k.views.end(), isView))
    return "has a view that is no direction, or is not known";
  return passedFault(k, before == nullptr ? k.stamp_ns : before->stamp_ns);  // none at the first
}

KeyframeView readView(ByteReader& in) {
  KeyframeView view;
  view.track_id = in.u32();
  for (int i = 0; i < 3; ++i) view.bearing_cam[i] = in.f32();
  view.information_rad2(0, 0) = in.f32();
  view.information_rad2(0, 1) = view.information_rad2(1, 0) = in.f32();
  view.information_rad2(1, 1) = in.f32();
  return view;
}

Keyframe readKeyframe(ByteReader& in) {
  Keyframe k;
  k.stamp_ns = in.i64();
  for (Eigen::Isometry3d* pose : {&k.T_map_base, &k.T_odom_base, &k.T_base_cam})
    *pose = readPose(in);
  for (double* value : {&k.focal_length_px, &k.way_variance_m2, &k.way_m}) *value = in.f64();
  const double height_m = in.f64();
  if (in.u32() != 0) k.height_m = height_m;
  k.floor = static_cast<int>(in.u32());
  const std::size_t views = in.u32();
  const std::size_t landmarks = in.u32();
  const std::size_t passed = in.u32();
  // No memory for what is not there. Products of these do not overflow 64 bits.
  if (std::uint64_t{kView} * views + std::uint64_t{kLandmark} * landmarks +
          std::uint64_t{kPassed} * passed >
      in.remaining())
    refuseSection(kFlightTag, "a keyframe has more than the section");
  k.views.reserve(views);
  for (std::size_t i = 0; i < views; ++i) k.views.push_back(readView(in));
  for (std::size_t i = 0; i < landmarks; ++i) {
    const std::uint32_t track_id = in.u32();
    k.landmarks.push_back({track_id, in.u32()});
  }
  for (std::size_t i = 0; i < passed; ++i) {
    const std::int64_t stamp_ns = in.i64();
    k.passed.push_back({stamp_ns, readPose(in)});
  }
  return k;
}

}  // namespace

std::string flightFault(const FlightRecord& flight) {
  const auto noise = noiseOf(flight.config);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    if (!isAmount(*noise[i]) || (i < kPositive && *noise[i] == 0))
      return "the noise of the flight is negative, or not finite";
  }
  if (!isAmount(flight.config.odometry.extrinsics_sigma_deg))
    return "the noise of the extrinsics is negative, or not finite";
  const Keyframe* before = nullptr;
  for (const Keyframe& keyframe : flight.keyframes) {
    const std::string fault = keyframeFault(keyframe, before);
    if (!fault.empty())
      return "the keyframe of " + std::to_string(keyframe.stamp_ns) + " ns " + fault;
    before = &keyframe;
  }
  return {};
}

LandmarkNumbers::LandmarkNumbers(const std::vector<std::uint32_t>& written) {
  number_of_.reserve(written.size());
  for (const std::uint32_t id : written) number_of_[id] = ++last_;
}

std::uint32_t LandmarkNumbers::of(std::uint32_t landmark_id) {
  const auto [found, is_new] = number_of_.emplace(landmark_id, last_ + 1);
  if (is_new) ++last_;
  return found->second;
}

std::uint64_t flightSize(const FlightRecord& flight) {
  std::uint64_t size = kNoise + kKeyframe * flight.keyframes.size();
  if (flight.config.odometry.extrinsics_sigma_deg > 0) size += kExtrinsics;
  for (const Keyframe& keyframe : flight.keyframes) {
    size += kView * keyframe.views.size() + kLandmark * keyframe.landmarks.size() +
            kPassed * keyframe.passed.size();
  }
  return size;
}

void writeFlightHead(const FlightRecord& flight, ByteWriter& out) {
  for (const double* value : noiseOf(flight.config)) out.f64(*value);
  out.u32(static_cast<std::uint32_t>(flight.keyframes.size()));
}

void writeKeyframe(const Keyframe& k, LandmarkNumbers& numbers, ByteWriter& out) {
  out.i64(k.stamp_ns);
  for (const Eigen::Isometry3d* pose : {&k.T_map_base, &k.T_odom_base, &k.T_base_cam})
    writePose(*pose, out);
  for (const double value : {k.focal_length_px, k.way_variance_m2, k.way_m, k.height_m.value_or(0)})
    out.f64(value);
  out.u32(k.height_m ? 1 : 0);
  out.u32(static_cast<std::uint32_t>(k.floor));
  for (const std::size_t count : {k.views.size(), k.landmarks.size(), k.passed.size()})
    out.u32(static_cast<std::uint32_t>(count));
  for (const KeyframeView& view : k.views) {
    out.u32(view.track_id);
    for (int i = 0; i < 3; ++i) out.f32(view.bearing_cam[i]);
    out.f32(view.information_rad2(0, 0));
    out.f32(view.information_rad2(0, 1));
    out.f32(view.information_rad2(1, 1));
  }
  for (const LandmarkTrack& seen : k.landmarks) {
    out.u32(seen.track_id);
    out.u32(numbers.of(seen.landmark_id));
  }
  for (const PassedFrame& frame : k.passed) {
    out.i64(frame.stamp_ns);
    writePose(frame.T_odom_base, out);
  }
}

void writeFlightTail(const FlightRecord& flight, ByteWriter& out) {
  const double sigma_deg = flight.config.odometry.extrinsics_sigma_deg;
  if (sigma_deg > 0) out.f64(sigma_deg);
}

void readFlight(ByteReader in, SavedMap& map) {
  FlightRecord& flight = map.flight;
  for (double* value : noiseOf(flight.config)) *value = in.f64();
  const std::uint32_t count = in.u32();
  if (std::uint64_t{kKeyframe} * count > in.remaining())
    refuseSection(kFlightTag, "it has more keyframes than fit into it");
  flight.keyframes.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) flight.keyframes.push_back(readKeyframe(in));
  if (in.remaining() == kExtrinsics) flight.config.odometry.extrinsics_sigma_deg = in.f64();
  if (in.isShort() || in.remaining() > 0) refuseSection(kFlightTag, "its size does not fit");
  const std::string fault = flightFault(flight);
  if (!fault.empty()) refuseSection(kFlightTag, fault);
}

}  // namespace ardrone_vslam
