// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

namespace ardrone_vslam {

/// Tells another floor below (a table) from climbing: heights that differ at once from those that
/// the motion foresees, and go on differing by the same.
class FloorWatch {
 public:
  /// What a height means.
  enum class Answer {
    kSame,  ///< the height is above the floor as it was
    kWait,  ///< it may be another floor: not to be used
    kOther  ///< it is: at floor_m()
  };

  /// @param least_step_m  heights that differ by less are of the same floor
  explicit FloorWatch(double least_step_m) : least_step_m_(least_step_m) {}

  /// One height, in order. @param innovation_m  measured less foreseen, of this sigma
  /// @param floor_m  what is below, by the position and this height
  Answer see(double time_s, double innovation_m, double sigma_m, double floor_m);
  /// Height of the floor that the last kOther told of, in the odometry's frame [m].
  double floor_m() const { return floor_m_; }
  /// Ends the waiting, as when heights were missing.
  void clear() { floors_.clear(); }

 private:
  struct Floor {
    double time_s;
    double height_m;
  };

  double least_step_m_;
  double since_s_ = 0;
  std::deque<Floor> floors_;  // of late, while waiting
  double floor_m_ = 0;
};

}  // namespace ardrone_vslam
