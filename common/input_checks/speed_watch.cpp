// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks/speed_watch.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ardrone_vslam {

void SpeedWatch::see(const OdometryState& state) {
  if (absurd_m_s_ > 0) return;  // said once
  const std::int64_t step_ns = state.stamp_ns - stamp_ns_;
  if (stamp_ns_ == 0 || step_ns <= 0) return begin(state);
  if (step_ns < kStep_ns) return;
  const Eigen::Vector3d step_m = state.T_odom_base.translation() - position_odom_;
  speeds_m_s_.push_back(step_m.norm() / (static_cast<double>(step_ns) * 1e-9));
  stamp_ns_ = state.stamp_ns;
  position_odom_ = state.T_odom_base.translation();
  if (stamp_ns_ - begin_ns_ < kWindow_ns || speeds_m_s_.size() < kSteps) return;
  const auto middle = speeds_m_s_.begin() + static_cast<std::ptrdiff_t>(speeds_m_s_.size() / 2);
  std::nth_element(speeds_m_s_.begin(), middle, speeds_m_s_.end());
  if (*middle > kAbsurd_m_s) absurd_m_s_ = *middle;
  begin(state);
}

void SpeedWatch::begin(const OdometryState& state) {
  begin_ns_ = stamp_ns_ = state.stamp_ns;
  position_odom_ = state.T_odom_base.translation();
  speeds_m_s_.clear();
}

std::string explainSpeed(const std::string& odometry, double speed_m_s) {
  std::ostringstream text;
  text << odometry << " moves at " << 10 * std::round(speed_m_s / 10)
       << " m/s for a second on end: metres are expected, so check the unit of its source (from "
          "millimetres divide by 1000)";
  return text.str();
}

}  // namespace ardrone_vslam
