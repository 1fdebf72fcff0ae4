// SPDX-License-Identifier: BSD-3-Clause
// The mapper's way of Features: refused with a reason, or a pose that is finite or said to be none.
#include <memory>

#include "conversions/conversions.hpp"
#include "fuzz/ros_bytes.hpp"
#include "inputs/frame_matcher.hpp"
#include "mapper/live_slam.hpp"
#include "stamps/stamp_guard.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam::fuzz {
namespace {

const SerialLayout& featuresLayout() {
  constexpr std::uint32_t kStart = 12;    // sequence number and stamp
  constexpr std::uint32_t kSize = 3 * 4;  // width, height, focal length
  constexpr std::uint32_t kCounts = 3 * 4 + 3 * 8;
  static const SerialLayout kLayout{false,
                                    {{kStart, 1},
                                     {kSize, 4},
                                     {0, 4},
                                     {0, 1},
                                     {0, 4},
                                     {0, 2},
                                     {0, 4},
                                     {0, 1},
                                     {0, 4},
                                     {0, 4},
                                     {kCounts, 1}}};
  return kLayout;
}

/// As MapperNodelet, without its topics.
class Mapper {
 public:
  Mapper(const SlamConfig& config)
      : warnings_([](const std::string& /*sentence*/) {}),
        slam_(config, warnings_),
        matcher_(config.odometry, 0.5, slam_.setup().clock()) {}

  void take(const OdometryState& state) { matcher_.addOdometry(state); }

  void take(const Features& message) {
    if (!faultOf(message).empty()) return;
    switch (stamps_.check(toNanoseconds(message.header.stamp))) {
      case StampGuard::Answer::kNotAfter:
      case StampGuard::Answer::kAlone:
        return;
      case StampGuard::Answer::kRestart:
        matcher_.forgetAfter(toNanoseconds(message.header.stamp) + StampGuard::kRestart_ns - 1);
        slam_.endMap();
        break;
      case StampGuard::Answer::kAscending:
        break;
    }
    matcher_.addFeatures(boost::make_shared<Features>(message), 0);
    const auto can_use = [this](const Features& features) {
      useCamera(features);
      return true;
    };
    while (const auto frame = matcher_.next(0, can_use)) process(*frame);
  }

 private:
  void useCamera(const Features& features) {
    const CameraIdentity camera = cameraOf(features);
    if (slam_.hasMap() && camera == slam_.camera()) return;
    slam_.useCamera(camera, test::forwardExtrinsics(), "base", camera.frame);
  }

  void process(const FrameMatcher::Frame& frame) {
    const FrameResult& result =
        slam_.process(*frame.features, frame.odometry, matcher_.odometries());
    if (result.state == SlamState::kNotFinite) return;
    require(isFinite(result), "a pose is finite, or said to be none");
    require(slam_.slam().T_map_odom().matrix().allFinite(), "and so is what goes to tf");
    for (const Landmark& landmark : slam_.slam().landmarks())
      require(landmark.position_map.allFinite(), "landmarks are finite");
  }

  Warnings warnings_;
  LiveSlam slam_;
  FrameMatcher matcher_;
  StampGuard stamps_;
};

SlamConfig configOf(std::uint8_t choice) {
  SlamConfig config;
  config.estimator = static_cast<EstimatorKind>(choice % EnumNames<EstimatorKind>::kNames.size());
  config.planar = (choice & 16U) != 0;
  return config;
}

/// Forward and to the left, so that there is parallax.
OdometryState odometryAt(std::int64_t stamp_ns, double x_m) {
  OdometryState state;
  state.stamp_ns = stamp_ns;
  state.T_odom_base.translation() << x_m, 0.5 * x_m, 1;
  return state;
}

Bytes flight(std::uint8_t choice, int frames, int points) {
  ViewFaults faults;
  faults.lost_share = 0;
  PointWorld world(1, faults);
  for (int i = 0; i < points; ++i)
    world.addPoint({3.0 + 0.4 * i, 0.3 * (i % 5) - 0.6, 1 + 0.2 * (i % 3)});
  Bytes bytes{choice};
  for (int i = 0; i < frames; ++i) {
    const OdometryState state = odometryAt(1'000'000'000 + 100'000'000 * std::int64_t{i}, 0.1 * i);
    const ImageFeatures features =
        world.look(state.T_odom_base * test::forwardExtrinsics(), state.stamp_ns);
    Features message;
    toMessage(features, "cam", message);
    bytes.push_back(10);  // cm forward
    putPart(bytes, serialized(message));
  }
  return bytes;
}

}  // namespace

std::vector<Bytes> seeds() {
  return {flight(0, 5, 4), flight(1, 5, 4),      flight(1, 8, 6),
          flight(2, 2, 2), flight(1 + 16, 3, 3), flight(1, 3, 0)};
}

std::size_t repair(std::uint8_t* /*data*/, std::size_t size, std::size_t /*most_size*/) {
  return size;
}

}  // namespace ardrone_vslam::fuzz

/// The estimator, then frames: how far the odometry went, and the message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  fuzz::FuzzInput input(data, size);
  fuzz::Mapper mapper(fuzz::configOf(input.take<std::uint8_t>()));
  double x_m = -0.1;
  while (input.left() > 0) {
    x_m += 0.01 * input.take<std::int8_t>();
    const fuzz::Bytes bytes = input.part(input.take<std::uint16_t>()).rest();
    const auto message = fuzz::deserialized<Features>(bytes, fuzz::featuresLayout());
    if (!message) continue;
    mapper.take(fuzz::odometryAt(toNanoseconds(message->header.stamp), x_m));
    mapper.take(*message);
  }
  return 0;
}
