// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/odometry_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "simulation/odometry_drift.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kBurstLength = 6;        // packets that the driver hands over together
constexpr double kBurstChance = 1.0 / 7;       // at each packet outside one: half come in bursts
constexpr std::uint64_t kTransportStream = 5;  // after those of OdometryDrift

std::vector<std::int64_t> measurementTimes(const Trajectory& truth, const OdometryProfile& profile,
                                           std::int64_t delay_ns) {
  const std::int64_t first_ns = truth.poses().front().stamp_ns - delay_ns;
  const std::int64_t last_ns = truth.poses().back().stamp_ns - delay_ns;
  std::vector<std::int64_t> times_ns{first_ns};
  while (times_ns.back() < last_ns) {
    const auto k = static_cast<double>(times_ns.size());
    times_ns.push_back(first_ns + std::llround(k * 1e9 / profile.rate_hz));
  }
  return times_ns;
}

/// What the way from the drone does: stamps of reception, losses, bursts. The first and the last
/// state arrive always, so that the stamps cover the images.
std::vector<OdometryState> transport(const std::vector<OdometryState>& measured,
                                     const OdometryProfile& profile, std::int64_t delay_ns,
                                     std::uint64_t seed) {
  RandomSource random(seed, kTransportStream);
  std::vector<OdometryState> received;
  received.reserve(measured.size());
  std::size_t burst_end = 0;  // one past the last state of the present burst
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (profile.bursts && i >= burst_end && i > 0 && random.chance(kBurstChance)) {
      burst_end = std::min(i + kBurstLength, measured.size());
    }
    const bool lost = random.chance(profile.loss) && i > 0 && i + 1 < measured.size();
    if (lost) continue;
    received.push_back(measured[i]);
    const std::size_t handed_over = i < burst_end ? burst_end - 1 : i;
    received.back().stamp_ns = measured[handed_over].stamp_ns + delay_ns;
  }
  return received;
}

}  // namespace

OdometryRun simulateOdometry(const Trajectory& truth, const OdometryProfile& profile,
                             std::uint64_t seed) {
  assert(!truth.empty() && "odometry needs a true trajectory");
  const std::int64_t delay_ns = std::llround(profile.delay_s * 1e9);
  const auto times_ns = measurementTimes(truth, profile, delay_ns);
  std::vector<OdometryState> measured;
  measured.reserve(times_ns.size());
  OdometryDrift drift(profile, seed);
  for (const std::int64_t time_ns : times_ns) {
    const double since_first_s = static_cast<double>(time_ns - times_ns.front()) * 1e-9;
    measured.push_back({time_ns, drift.report(truth.at(time_ns), since_first_s), Matrix6d::Zero()});
  }
  if (profile.isTruth()) return {measured, 0};
  return {transport(measured, profile, delay_ns, seed), drift.scaleError(), delay_ns != 0};
}

}  // namespace ardrone_vslam
