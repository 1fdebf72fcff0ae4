// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// For how long the odometry has led from an anchor of the map to the present without anything seen
/// to check it by.
class TimeSinceFix {
 public:
  /// Nothing was recognised for so long.
  void pass(double blind_s) { now_s_ += blind_s; }
  /// A fix by landmarks of these anchors. Anchors of their time and since are in place with them.
  void link(const std::vector<std::uint32_t>& anchor_ids) {
    double first_s = std::numeric_limits<double>::infinity();
    for (const std::uint32_t id : anchor_ids) first_s = std::min(first_s, linked(id));
    for (auto& [id, linked_s] : linked_s_) {
      if (linked_s >= first_s) linked_s = now_s_;
    }
  }
  /// Drifts take part from when they are first given.
  /// @param widening_s  deviations are twice as large after so long, three times after twice as
  /// long
  void widen(std::vector<AnchorDrift>& drifts, double widening_s) {
    std::unordered_map<std::uint32_t, double> still_there;
    for (AnchorDrift& drift : drifts) {
      const double linked_s = linked(drift.anchor_id);
      still_there[drift.anchor_id] = linked_s;
      const double widening = 1 + (now_s_ - linked_s) / widening_s;
      drift.position_m2 *= widening * widening;
      drift.attitude_rad2 *= widening * widening;
    }
    linked_s_.swap(still_there);
  }

 private:
  double linked(std::uint32_t anchor_id) const {
    const auto entry = linked_s_.find(anchor_id);
    return entry == linked_s_.end() ? now_s_ : entry->second;
  }

  double now_s_ = 0;
  std::unordered_map<std::uint32_t, double> linked_s_;  // by anchor
};

}  // namespace ardrone_vslam
