// SPDX-License-Identifier: BSD-3-Clause
// What robots and drivers say of their motion, message by message: refused, or states that are
// finite and within bounds, and a pose in map that is.
#include <array>
#include <string>

#include "ardrone_vslam/odometry_adapter.hpp"
#include "conversions/conversions.hpp"
#include "fuzz/ros_bytes.hpp"
#include "inputs/odometry_intake.hpp"
#include "with_ros/imu_conversion.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam::fuzz {
namespace {

enum Kind : std::uint8_t { kOdometry, kImu, kNavdata, kCommand, kRange, kCorrection, kKinds };

const SerialLayout& correctionLayout() {
  constexpr std::uint32_t kStart = 12;  // sequence number and stamp
  constexpr std::uint32_t kPose = 7 * 8;
  static const SerialLayout kLayout{false, {{kStart, 1}, {0, 1}, {3 * kPose + 36 * 8 + 8 + 1, 0}}};
  return kLayout;
}

/// The mapper's odometry inputs, and the fusion's.
class Inputs {
 public:
  explicit Inputs(OdometryMode mode) : intake_(configOf(mode)), heights_({}, 10), fusion_({}) {}

  void take(Kind kind, const Bytes& bytes) {
    switch (kind) {
      case kOdometry:
        return with<nav_msgs::Odometry>(bytes);
      case kImu:
        return with<sensor_msgs::Imu>(bytes);
      case kNavdata:
        return with<Navdata>(bytes);
      case kCommand:
        return with<geometry_msgs::Twist>(bytes);
      case kRange:
        return with<sensor_msgs::Range>(bytes);
      default:
        if (const auto message = deserialized<PoseCorrection>(bytes, correctionLayout()))
          take(*message);
    }
  }

 private:
  static OdometryAdapterConfig configOf(OdometryMode mode) {
    OdometryAdapterConfig config;
    config.mode = mode;
    return config;
  }

  template <class Message>
  void with(const Bytes& bytes) {
    if (const auto message = deserialized<Message>(bytes)) take(*message);
  }

  void take(const nav_msgs::Odometry& message) {
    const auto state = toUnboundedState(message);
    require(state.value.has_value() == state.fault.empty(), "odometry, or a reason");
    if (!state.value) return;
    made_.clear();
    by_imu_.push(*state.value, made_);
    handOn("ImuOdometry");
    use(*state.value);
  }

  void take(const sensor_msgs::Imu& message) {
    made_.clear();
    const auto attitude = toImuAttitude(message, Eigen::Quaterniond::Identity());
    if (attitude.value) by_imu_.push(*attitude.value, made_);
    handOn("ImuOdometry");
    made_.clear();
    const auto imu = toDroneImu(message);
    if (imu.value) observer_.push(*imu.value, made_);
    handOn("DroneObserver");
  }

  void take(const Navdata& message) {
    made_.clear();
    const auto reading = toNavdataReading(message);
    if (reading.value) observer_.push(*reading.value, made_);
    handOn("DroneObserver");
    use(toHeightReading(message));
  }

  void take(const geometry_msgs::Twist& message) {
    observer_.push(toDroneCommand(message, fusion_.newestStamp_ns() + 1));
  }

  void take(const sensor_msgs::Range& message) { use(toRangeReading(message)); }

  void take(const PoseCorrection& message) {
    const auto correction = toLateCorrection(message);
    require(correction.value.has_value() == correction.fault.empty(), "a correction, or a reason");
    if (!correction.value) return;
    fusion_.correct(*correction.value);
    for (const MapState& state : fusion_.sinceCorrection()) requireFinite(state);
  }

  void use(const Checked<RangeReading>& reading) {
    if (reading.value) heights_.push(*reading.value);
  }

  /// What the observers make goes the way of any odometry.
  void handOn(const std::string& maker) {
    for (const OdometryState& state : made_) {
      require(state.T_odom_base.matrix().allFinite() && state.covariance.allFinite(),
              maker + " makes finite states");
      use(state);
    }
  }

  void use(const OdometryState& message) {
    if (intake_.check(message.stamp_ns) == StampGuard::Answer::kAlone) return;
    intake_.take(message);
    std::int64_t before_ns = 0;
    for (const OdometryState& state : intake_.ready()) {
      require(state.stamp_ns > before_ns, "stamps ascend");
      before_ns = state.stamp_ns;
      if (fusion_.push(state) == OdometryBuffer::Push::kAccepted) requireWithinBounds(state);
    }
    if (const auto newest = fusion_.newest()) requireFinite(*newest);
  }

  void requireWithinBounds(const OdometryState& state) {
    require(state.T_odom_base.matrix().allFinite(), "states are finite");
    require(rangeFault(state).empty(), "and within bounds");
    const auto height_m = heights_.at(state);
    require(!height_m || std::isfinite(*height_m), "and so are heights");
  }

  static void requireFinite(const MapState& state) {
    require(state.T_map_base.matrix().allFinite(), "poses in map are finite");
    require(state.covariance.allFinite(), "and their covariances");
  }

  OdometryIntake intake_;
  HeightInput heights_;
  DelayedFusion fusion_;
  ImuOdometry by_imu_;
  DroneObserver observer_;
  std::vector<OdometryState> made_;
};

void add(Bytes& bytes, Kind kind, const Bytes& message) {
  bytes.push_back(kind);
  putPart(bytes, message);
}

ros::Time stamp(int i) {
  return ros::Time(100 + 0.1 * i);
}

nav_msgs::Odometry odometryAt(int i, double x_m) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = stamp(i);
  odometry.pose.pose.position.x = x_m;
  odometry.pose.pose.orientation.w = 1;
  odometry.pose.covariance[0] = 0.01;
  odometry.twist.twist.linear.x = 1;
  return odometry;
}

PoseCorrection correctionAt(int i, double x_m) {
  PoseCorrection correction;
  correction.header.stamp = stamp(i);
  correction.observer_pose.position.x = x_m;
  correction.observer_pose.orientation.w = 1;
  correction.fused_pose.pose.position.x = x_m + 0.5;
  correction.fused_pose.pose.orientation.w = 1;
  for (std::size_t k = 0; k < 6; ++k) correction.fused_pose.covariance[7 * k] = 0.01;
  return correction;
}

Bytes odometryFlight(OdometryMode mode, bool with_bursts) {
  Bytes bytes{static_cast<std::uint8_t>(mode)};
  for (int i = 0; i < 6; ++i) {
    add(bytes, kOdometry, serialized(odometryAt(with_bursts ? i / 2 : i, 0.1 * i)));
    if (i % 2 == 1) add(bytes, kCorrection, serialized(correctionAt(i, 0.1 * i)));
    sensor_msgs::Range range;
    range.header.stamp = stamp(i);
    range.range = 1;
    range.max_range = 5;
    if (i % 3 == 0) add(bytes, kRange, serialized(range));
  }
  return bytes;
}

Bytes observedFlight(OdometryMode mode) {
  Bytes bytes{static_cast<std::uint8_t>(mode)};
  for (int i = 0; i < 8; ++i) {
    sensor_msgs::Imu imu;
    imu.header.stamp = stamp(i);
    imu.orientation.w = 1;
    imu.linear_acceleration.z = 9.81;
    add(bytes, kImu, serialized(imu));
    if (mode == OdometryMode::kImu) add(bytes, kOdometry, serialized(odometryAt(i, 0.1 * i)));
    Navdata navdata;
    navdata.header.stamp = stamp(i);
    navdata.state = 3;
    navdata.vx = 1000;
    navdata.az = 1;
    navdata.altd = 1000;
    if (mode == OdometryMode::kNavdata) add(bytes, kNavdata, serialized(navdata));
    if (i == 3) add(bytes, kCommand, serialized(geometry_msgs::Twist()));
  }
  return bytes;
}

}  // namespace

std::vector<Bytes> seeds() {
  return {odometryFlight(OdometryMode::kPose, false), odometryFlight(OdometryMode::kPose, true),
          odometryFlight(OdometryMode::kTwist, false), observedFlight(OdometryMode::kNavdata),
          observedFlight(OdometryMode::kImu)};
}

std::size_t repair(std::uint8_t* /*data*/, std::size_t size, std::size_t /*most_size*/) {
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  fuzz::FuzzInput input(data, size);
  constexpr std::size_t kModes = EnumNames<OdometryMode>::kNames.size();
  fuzz::Inputs inputs(static_cast<OdometryMode>(input.take<std::uint8_t>() % kModes));
  while (input.left() > 0) {
    const auto kind = static_cast<fuzz::Kind>(input.take<std::uint8_t>() % fuzz::kKinds);
    inputs.take(kind, input.part(input.take<std::uint16_t>()).rest());
  }
  return 0;
}
