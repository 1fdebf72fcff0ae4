// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "linear/scalars.hpp"
#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// For how long the odometry has led from an anchor of the map to the present without anything seen
/// to check it by.
class TimeSinceFix {
 public:
  /// A frame's search is widened by the blind time before the last frame, so that odometry that is
  /// as good as it claims has narrow windows; but a gap is blind from its beginning.
  void see(std::int64_t stamp_ns) {
    constexpr double kGap_s = 0.5;  // slower cameras are searched as after a gap
    uncounted_s_ = last_stamp_ns_ ? seconds(stamp_ns - *last_stamp_ns_) : 0;
    last_stamp_ns_ = stamp_ns;
    if (uncounted_s_ < kGap_s) return;
    pass(uncounted_s_);
    uncounted_s_ = 0;
  }
  /// Nothing was recognised in the frame seen last.
  void passFrame() { pass(uncounted_s_); }
  /// Nothing was recognised for so long.
  void pass(double duration_s) { since_fix_s_ += duration_s; }
  /// A fix by landmarks of these anchors. Anchors of their time and since are in place with them.
  void link(const std::vector<std::uint32_t>& anchor_ids) {
    double first_s = std::numeric_limits<double>::infinity();
    for (const std::uint32_t id : anchor_ids) first_s = std::min(first_s, linked(id));
    for (auto& [id, linked_s] : linked_s_) {
      if (linked_s >= first_s) linked_s = since_fix_s_;
    }
  }
  /// Drifts take part from when they are first given; they ascend in their anchors' ids.
  /// @param widening_s  sigmas are twice as large after so long, three times after twice as
  /// long
  void widen(std::vector<AnchorDrift>& drifts, double widening_s) {
    still_there_.clear();
    for (AnchorDrift& drift : drifts) {
      const double linked_s = linked(drift.anchor_id);
      still_there_.emplace_back(drift.anchor_id, linked_s);
      const double widening = 1 + (since_fix_s_ - linked_s) / widening_s;
      drift.position_m2 *= widening * widening;
      drift.attitude_rad2 *= widening * widening;
    }
    linked_s_.swap(still_there_);
  }

 private:
  double linked(std::uint32_t anchor_id) const {
    const auto entry =
        std::lower_bound(linked_s_.begin(), linked_s_.end(), anchor_id,
                         [](const auto& one, std::uint32_t id) { return one.first < id; });
    return entry == linked_s_.end() || entry->first != anchor_id ? since_fix_s_ : entry->second;
  }

  double since_fix_s_ = 0;
  std::optional<std::int64_t> last_stamp_ns_;
  double uncounted_s_ = 0;  // since the frame before, and not yet in since_fix_s_
  using LinkedAnchor = std::pair<std::uint32_t, double>;  // id, linked_s
  std::vector<LinkedAnchor> linked_s_;                    // ascending in the id
  std::vector<LinkedAnchor> still_there_;                 // kept for its memory
};

}  // namespace ardrone_vslam
