// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/setup_watch.hpp"
#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/time_offset.hpp"

namespace ardrone_vslam {

/// When images were exposed, on the odometry's clock: at their stamps plus an offset, that which is
/// told or, where that is `auto`, the one that is found while flying.
class ImageClock {
 public:
  /// @param told_s  the parameter image_time_offset_s
  explicit ImageClock(const NumberOrAuto& told_s);

  /// To be called before the first image. Another camera has the same clock: what was found stays.
  void useCamera(const Eigen::Isometry3d& T_base_cam);
  /// Of an image that is to be seen next. The way to an offset that was found takes several images,
  /// so that exposures ascend where stamps do.
  std::int64_t exposed_ns(std::int64_t stamp_ns) const;
  /// One image; `odometry` need only reach to its exposure.
  /// @param fault  of the set-up. Offsets are found without one, and with kTimeOffset
  /// @return by how much the offset is another one from this image on, as one was found; else 0
  double see(const ImageFeatures& features, const OdometryBuffer& odometry, SetupFault fault);

  /// The offset in use, or on the way to it.
  double used_s() const { return static_cast<double>(offset_ns_) * 1e-9; }
  /// The parameter.
  const NumberOrAuto& told_s() const { return told_s_; }
  /// By the images seen so far.
  TimeOffset estimate() const;

 private:
  NumberOrAuto told_s_;
  std::optional<TimeOffsetEstimator> estimator_;
  std::int64_t offset_ns_;
  std::int64_t lagging_ns_;     // that of the image seen last, which may be on the way to it
  std::int64_t left_ns_;        // where the way began, or offset_ns_
  std::int64_t newest_ns_ = 0;  // stamp of that image; 0: none
};

/// What a Slam is told of the set-up: when images were exposed, and whether a fault makes images
/// and odometry contradict each other. It outlives the Slam when the map begins anew.
class SetupMonitor {
 public:
  /// @param told_s  the parameter image_time_offset_s
  explicit SetupMonitor(const NumberOrAuto& told_s) : clock_(told_s) {}

  /// To be called before the first image. Faults are looked for anew; the clock goes on.
  void useCamera(const Eigen::Isometry3d& T_base_cam);
  /// The image that `slam` is to process next; `odometry` must keep at least a second, and reach to
  /// its exposure.
  /// @return whether an offset that was found is used from this image on
  bool see(const ImageFeatures& features, const OdometryBuffer& odometry, Slam& slam);

  /// When images were exposed.
  const ImageClock& clock() const { return clock_; }
  /// After the images so far.
  const SetupFinding& finding() const { return finding_; }

 private:
  Eigen::Isometry3d T_base_cam_ = Eigen::Isometry3d::Identity();
  ImageClock clock_;
  std::optional<SetupWatch> watch_;  // none before the first camera
  SetupFinding finding_;
};

}  // namespace ardrone_vslam
