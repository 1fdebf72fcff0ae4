// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_contents.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kMinStamp_ns = 1'000'000'000;
constexpr std::int64_t kOffset_ns = 100'000'000'000;
constexpr std::int64_t kMaxStamp_ns = std::int64_t{0xffffffff} * 1'000'000'000;

/// ROS has no time 0 (it means "not set", "the latest" to tf) and none before it.
void shiftStamps(BagContents& contents, const std::string& name) {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
  const auto forEachStamp = [&contents](auto&& action) {
    for (auto& stamp_ns : contents.image_stamps_ns) action(stamp_ns);
    for (auto& state : contents.odometry) action(state.stamp_ns);
    for (auto& pose : contents.truth) action(pose.stamp_ns);
    for (auto& reading : contents.ranges) action(reading.stamp_ns);
  };
  forEachStamp([&](std::int64_t stamp_ns) {
    first_ns = std::min(first_ns, stamp_ns);
    last_ns = std::max(last_ns, stamp_ns);
  });
  const std::int64_t offset_ns = first_ns < kMinStamp_ns ? kOffset_ns : 0;
  if (first_ns < kMinStamp_ns - kOffset_ns || last_ns > kMaxStamp_ns - offset_ns) {
    throw std::runtime_error(name +
                             ": its stamps are outside of ROS's time (0 to 2^32 s); "
                             "give stamps in seconds from 0 or from 1970");
  }
  forEachStamp([offset_ns](std::int64_t& stamp_ns) { stamp_ns += offset_ns; });
  contents.stamp_offset_ns = offset_ns;
}

}  // namespace

std::int64_t BagContents::firstStamp_ns() const {
  std::int64_t first_ns = image_stamps_ns.front();
  if (!odometry.empty()) first_ns = std::min(first_ns, odometry.front().stamp_ns);
  if (!truth.empty()) first_ns = std::min(first_ns, truth.front().stamp_ns);
  if (!ranges.empty()) first_ns = std::min(first_ns, ranges.front().stamp_ns);
  return first_ns;
}

BagContents contentsOf(const Sequence& sequence, const std::optional<OdometryProfile>& profile,
                       std::uint64_t seed) {
  BagContents contents;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    contents.image_stamps_ns.push_back(sequence.stamp_ns(i));
  }
  contents.truth = sequence.truth().poses();
  contents.ranges = sequence.ranges();
  contents.odometry = sequence.odometry();
  if (profile) {
    if (sequence.truth().empty()) {
      throw std::runtime_error(sequence.name() + ": has no true poses that the odometry profile '" +
                               profile->name + "' could corrupt; give the truth, or no profile");
    }
    OdometryRun run = simulateOdometry(sequence.truth(), *profile, seed);
    contents.odometry = std::move(run.states);
    contents.scale_error = run.scale_error;
  }
  shiftStamps(contents, sequence.name());
  return contents;
}

}  // namespace ardrone_vslam
