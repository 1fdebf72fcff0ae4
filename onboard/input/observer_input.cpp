// SPDX-License-Identifier: BSD-3-Clause
#include "input/observer_input.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/clocks.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam {
namespace {

/// A quaternion's norm may be off by rounding, floats included; beyond it is nonsense.
constexpr double kNormTolerance = 1e-3;

bool isFinite(const VslamObserver& o) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return std::all_of(std::begin(o.position_m), std::end(o.position_m), is_finite) &&
         std::all_of(std::begin(o.quaternion), std::end(o.quaternion), is_finite) &&
         std::all_of(std::begin(o.variance), std::end(o.variance), is_finite) &&
         std::isfinite(o.height_m);
}

std::optional<OdometryState> toState(const VslamObserver& o) {
  const Eigen::Quaterniond q(o.quaternion[3], o.quaternion[0], o.quaternion[1], o.quaternion[2]);
  if (!isFinite(o) || std::abs(q.norm() - 1) > kNormTolerance || o.stamp_ns <= 0 ||
      o.stamp_ns > kLatestStamp_ns)
    return std::nullopt;
  OdometryState state;
  state.stamp_ns = o.stamp_ns;
  state.T_odom_base =
      Eigen::Translation3d(o.position_m[0], o.position_m[1], o.position_m[2]) * q.normalized();
  if ((o.flags & VSLAM_OBSERVER_HAS_VARIANCE) != 0) {
    for (int i = 0; i < 6; ++i) state.covariance(i, i) = o.variance[i];
  }
  if ((o.flags & VSLAM_OBSERVER_HAS_HEIGHT) != 0) state.height_m = o.height_m;
  return state;
}

}  // namespace

std::optional<OdometryState> ObserverInput::read(const std::uint8_t* record, std::size_t size,
                                                 std::int64_t now_ns) {
  VslamObserver observer;
  switch (vslam_read_observer(record, size, &observer)) {
    case VSLAM_WRONG_SIZE:
      ++counts_.wrong_size;
      return std::nullopt;
    case VSLAM_WRONG_KIND:
      ++counts_.wrong_kind;
      return std::nullopt;
    case VSLAM_CORRUPTED:
      ++counts_.corrupted;
      return std::nullopt;
    case VSLAM_GOOD:
      break;
  }
  // Sequence numbers wrap around.
  const bool is_newer = static_cast<std::int32_t>(observer.sequence - sequence_) > 0;
  if (has_heard_ && !is_newer && now_ns - heard_ns_ < kForget_ns) {
    ++counts_.old;
    return std::nullopt;
  }
  auto state = toState(observer);
  if (!state) {
    ++counts_.refused;
    return std::nullopt;
  }
  has_heard_ = true;
  heard_ns_ = now_ns;
  sequence_ = observer.sequence;
  ++counts_.accepted;
  return state;
}

bool ObserverInput::isSilent(std::int64_t now_ns, double limit_s) const {
  return !has_heard_ || static_cast<double>(now_ns - heard_ns_) > limit_s * 1e9;
}

}  // namespace ardrone_vslam
