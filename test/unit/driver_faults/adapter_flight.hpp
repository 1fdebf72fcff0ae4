// SPDX-License-Identifier: BSD-3-Clause
// A flight of circles as drivers tell it, and the adapter that is fed with it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "ardrone_vslam/odometry_adapter.hpp"

namespace ardrone_vslam::test {

constexpr double kEpoch_s = 1.7e9;
constexpr double kStart_s = 100;

/// Circles at 1 m/s, the nose along the way, in 1.5 m with the height going up and down.
inline OdometryState truthAt(double time_s) {
  constexpr double kRadius_m = 2;
  constexpr double kRotation_rad_s = 0.5;
  const double yaw_rad = kRotation_rad_s * time_s;
  OdometryState state;
  state.stamp_ns = std::llround((kStart_s + time_s) * 1e9);
  state.T_odom_base.linear() = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  state.T_odom_base.translation() << kRadius_m * std::sin(yaw_rad),
      kRadius_m * (1 - std::cos(yaw_rad)), 1.5 + 0.8 * std::sin(0.4 * time_s);
  const Eigen::Vector3d velocity_odom_m_s(kRadius_m * kRotation_rad_s * std::cos(yaw_rad),
                                          kRadius_m * kRotation_rad_s * std::sin(yaw_rad),
                                          0.32 * std::cos(0.4 * time_s));
  state.twist_base.head<3>() = state.T_odom_base.linear().transpose() * velocity_odom_m_s;
  return state;
}

/// What of the driver is switched on.
struct Faults {
  bool mirrored_yaw = false;
  double epoch_at_s = -1;
  bool whole_metres = false;
  bool bursts = false;
};

constexpr double kStep_s = 0.005;

/// Where there are bursts: of twelve messages, five come with the stamp of the sixth.
inline void addBurst(bool are_there, int i, OdometryState& message) {
  if (are_there && i % 12 < 5) message.stamp_ns = truthAt((i - i % 12 + 5) * kStep_s).stamp_ns;
}

/// Sixty seconds at 200 Hz as the driver sends them: x and y integrated by itself.
inline std::vector<OdometryState> messagesOf(const Faults& faults) {
  std::vector<OdometryState> messages;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  bool has_jumped = false;
  for (int i = 0; i < 12000; ++i) {
    OdometryState message = truthAt(i * kStep_s);
    Eigen::Vector2d velocity_m_s =
        (message.T_odom_base.linear() * message.twist_base.head<3>()).head<2>();
    if (faults.mirrored_yaw) velocity_m_s.y() *= -1;  // the nose is along the way
    const bool jumps_now =
        faults.epoch_at_s >= 0 && !has_jumped && i * kStep_s >= faults.epoch_at_s;
    if (jumps_now) position_m.setZero();  // a driver that starts
    has_jumped = has_jumped || jumps_now;
    if (i > 0) position_m += velocity_m_s * (jumps_now ? kEpoch_s : kStep_s);
    message.T_odom_base.translation().head<2>() = position_m;
    double& z_m = message.T_odom_base.translation().z();
    if (faults.whole_metres) z_m = std::floor(z_m);
    addBurst(faults.bursts, i, message);
    messages.push_back(message);
  }
  return messages;
}

class AdapterFlight : public ::testing::Test {
 protected:
  void feed(const std::vector<OdometryState>& messages, OdometryMode mode,
            OdometryHeight height = OdometryHeight::kPose) {
    adapter_ = std::make_unique<OdometryAdapter>(OdometryAdapterConfig{mode, height});
    states_.clear();
    refused_ = 0;
    for (const OdometryState& message : messages) {
      if (adapter_->push(message, states_) != OdometryBuffer::Push::kAccepted) ++refused_;
    }
    EXPECT_EQ(adapter_->flush(states_), OdometryBuffer::Push::kAccepted);
    for (std::size_t i = 1; i < states_.size(); ++i)
      ASSERT_GT(states_[i].stamp_ns, states_[i - 1].stamp_ns) << i;
  }

  static Eigen::Vector3d errorOf_m(const OdometryState& state) {
    const double time_s = static_cast<double>(state.stamp_ns) * 1e-9 - kStart_s;
    return state.T_odom_base.translation() - truthAt(time_s).T_odom_base.translation();
  }
  double worst_m() const {
    double worst = 0;
    for (const OdometryState& state : states_)
      worst = std::max(worst, errorOf_m(state).head<2>().norm());
    return worst;
  }
  double worstHeight_m() const {
    double worst = 0;
    for (const OdometryState& state : states_)
      worst = std::max(worst, std::abs(errorOf_m(state).z()));
    return worst;
  }
  std::uint64_t count(OdometryFault fault) const {
    return adapter_->faults()[static_cast<std::size_t>(fault)];
  }

  std::unique_ptr<OdometryAdapter> adapter_;
  std::vector<OdometryState> states_;
  int refused_ = 0;
};

}  // namespace ardrone_vslam::test
