// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/drone_clock.hpp"

#include <ros/time.h>

#include <cmath>

#include "conversions/conversions.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

std::optional<std::int64_t> DroneClock::toOwn(std::int64_t drone_ns) {
  if (drone_ns < drone_ns_) return std::nullopt;
  if (drone_ns == drone_ns_) return own_ns_;
  drone_ns_ = drone_ns;
  if (is_same_) {
    check(drone_ns);
    own_ns_ = drone_ns;
  } else {
    own_ns_ = map_.map(drone_ns, toNanoseconds(ros::Time::now()));
  }
  return own_ns_;
}

void DroneClock::clear() {
  map_.clear();
  drone_ns_ = 0;
}

void DroneClock::check(std::int64_t drone_ns) {
  constexpr double kApart_s = 5;  // more than any delay of a link that is of use
  const double late_s = ros::Time::now().toSec() - static_cast<double>(drone_ns) * 1e-9;
  fault_.clear();
  if (std::abs(late_s) < kApart_s) return;
  fault_ = text("the drone's stamps are ", std::abs(late_s), " s ", late_s > 0 ? "before" : "after",
                " this computer's time: synchronise both clocks and set vslam_onboard's "
                "`realtime_clock`, or set `same_clock` to false");
  warnings_.limited("same_clock", fault_);
}

void DroneClock::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  if (!is_same_)
    wrapper.add("this computer's clock less the drone's [s]",
                static_cast<double>(map_.offset_ns()) * 1e-9);
  if (!fault_.empty()) wrapper.add("clocks", fault_);
}

}  // namespace ardrone_vslam
