// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/imu_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr std::size_t kMostKept = 10000;            // of each input, whatever their stamps are
constexpr std::int64_t kNewRun_ns = 1'000'000'000;  // stamps further back are a new run

}  // namespace

Push ImuOdometry::push(const ImuAttitude& attitude, std::vector<OdometryState>& ready) {
  if (!attitude.R_world_base.coeffs().allFinite()) return Push::kNotFinite;
  if (!attitudes_.empty() && attitude.stamp_ns <= attitudes_.back().stamp_ns) {
    if (attitude.stamp_ns == attitudes_.back().stamp_ns) return Push::kDuplicateStamp;
    if (attitude.stamp_ns > attitudes_.back().stamp_ns - kNewRun_ns) return Push::kBackwardStamp;
    beginAnew(attitude.stamp_ns, attitudes_.back().stamp_ns, attitudes_, waiting_);
  }
  attitudes_.push_back(attitude);
  takeReady(ready);
  while (attitudes_.size() > kMostKept ||
         attitudes_.back().stamp_ns - attitudes_.front().stamp_ns > 2 * kLongestWait_ns)
    attitudes_.pop_front();
  return Push::kAccepted;
}

Push ImuOdometry::push(const OdometryState& odometry, std::vector<OdometryState>& ready) {
  if (!odometry.T_odom_base.matrix().allFinite()) return Push::kNotFinite;
  // Sums of such ways leave a double's range, and no later message would bring them back.
  if (isBeyondAllJumps(odometry)) return Push::kOutOfRange;
  const OdometryState* before = !waiting_.empty() ? &waiting_.back() : last_ ? &*last_ : nullptr;
  if (before && odometry.stamp_ns < before->stamp_ns) {
    if (odometry.stamp_ns > before->stamp_ns - kNewRun_ns) return Push::kBackwardStamp;
    beginAnew(odometry.stamp_ns, before->stamp_ns, waiting_, attitudes_);
  }
  waiting_.push_back(odometry);
  takeReady(ready);
  return Push::kAccepted;
}

/// Of the two inputs one finds first that time began anew; what the other has is of the new run
/// where its newest is nearer to the new stamp than to the old newest.
template <class Input, class Other>
void ImuOdometry::beginAnew(std::int64_t stamp_ns, std::int64_t old_ns, std::deque<Input>& own,
                            std::deque<Other>& other) {
  const auto dropFrom = [stamp_ns](auto& inputs) {
    while (!inputs.empty() && inputs.back().stamp_ns >= stamp_ns) inputs.pop_back();
  };
  dropFrom(own);
  const std::int64_t middle_ns = stamp_ns + (old_ns - stamp_ns) / 2;
  if (!other.empty() && other.back().stamp_ns > middle_ns) dropFrom(other);
  if (last_ && last_->stamp_ns >= stamp_ns) last_.reset();
}

void ImuOdometry::takeReady(std::vector<OdometryState>& ready) {
  while (!waiting_.empty()) {
    const OdometryState& next = waiting_.front();
    const bool is_known = !attitudes_.empty() && attitudes_.back().stamp_ns >= next.stamp_ns;
    if (!is_known && waiting_.size() <= kMostKept &&
        waiting_.back().stamp_ns - next.stamp_ns <= kLongestWait_ns)
      return;
    const auto attitude = is_known ? attitudeAt(next.stamp_ns) : std::nullopt;
    if (attitude) {
      use(next, *attitude, ready);
    } else {
      ++without_attitude_;
    }
    waiting_.pop_front();
  }
}

void ImuOdometry::use(const OdometryState& odometry, const Eigen::Quaterniond& R_world_base,
                      std::vector<OdometryState>& ready) {
  const Eigen::Vector3d up_by_imu = R_world_base.inverse() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up = odometry.T_odom_base.linear().row(2);
  if (!last_ && up.dot(up_by_imu) < portable::cos(kMostTilt_deg * M_PI / 180)) {
    ++tilted_;
    return;
  }
  ready.push_back(laid(odometry, R_world_base));
  last_ = odometry;
}

std::optional<Eigen::Quaterniond> ImuOdometry::attitudeAt(std::int64_t stamp_ns) const {
  const auto after =
      std::lower_bound(attitudes_.begin(), attitudes_.end(), stamp_ns,
                       [](const ImuAttitude& a, std::int64_t t) { return a.stamp_ns < t; });
  if (after->stamp_ns == stamp_ns) return after->R_world_base;
  if (after == attitudes_.begin()) return std::nullopt;
  const ImuAttitude& before = *std::prev(after);
  const std::int64_t gap_ns = after->stamp_ns - before.stamp_ns;
  if (gap_ns > kLongestGap_ns) return std::nullopt;
  const double share =
      static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(gap_ns);
  return Eigen::Quaterniond(rotationBetween(before.R_world_base.toRotationMatrix(),
                                            after->R_world_base.toRotationMatrix(), share));
}

OdometryState ImuOdometry::laid(const OdometryState& odometry,
                                const Eigen::Quaterniond& R_world_base) {
  const Eigen::Matrix3d reported = odometry.T_odom_base.linear();
  if (!last_) {
    R_odom_world_ = rotationAboutZ(yawOf(reported) - yawOf(R_world_base.toRotationMatrix()));
    T_odom_base_.translation() = odometry.T_odom_base.translation();
  }
  const Eigen::Matrix3d attitude = (R_odom_world_ * R_world_base).toRotationMatrix();
  if (last_) {
    const Eigen::Isometry3d& before = last_->T_odom_base;
    const Eigen::Vector3d way_m = odometry.T_odom_base.translation() - before.translation();
    // Base turns on the way: its axes at both ends count alike.
    T_odom_base_.translation() +=
        0.5 * (T_odom_base_.linear() * (before.linear().transpose() * way_m) +
               attitude * (reported.transpose() * way_m));
  }
  T_odom_base_.linear() = attitude;
  OdometryState state = odometry;
  state.T_odom_base = T_odom_base_;
  return state;
}

}  // namespace ardrone_vslam
