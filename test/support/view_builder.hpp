// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "matching/frame_view.hpp"
#include "support/point_flight.hpp"
#include "support/point_world.hpp"

namespace ardrone_vslam::test {

/// Single views put together feature by feature, of a camera that looks along map's x.
class ViewBuilder {
 public:
  ViewBuilder() : maker_(99) {}

  /// Begins a new view without features.
  void lookFrom(const Eigen::Vector3d& position_map, bool planar = false) {
    stamp_ns_ += 100'000'000;
    planar_ = planar;
    T_map_cam_ = forwardExtrinsics();
    T_map_cam_.translation() = position_map;
    features_ = maker_.emptyView(stamp_ns_);
    stale_ = true;
  }
  void setStamp(std::int64_t stamp_ns) { stamp_ns_ = stamp_ns - 100'000'000; }

  /// @return the feature's index
  int addPoint(const Eigen::Vector3d& point_map, std::uint32_t track_id,
               const Descriptor& descriptor = {}) {
    const Eigen::Vector3d bearing = (T_map_cam_.inverse() * point_map).normalized();
    return addBearing(bearing, track_id, descriptor);
  }
  /// A feature this many pixels right of and below the optical axis.
  int addPixel(double right_px, double down_px, std::uint32_t track_id,
               const Descriptor& descriptor = {}) {
    return addBearing(Eigen::Vector3d(right_px, down_px, kPointFocalLength_px).normalized(),
                      track_id, descriptor);
  }
  /// Corners of the image without track and like no other descriptor: the first view needs them so
  /// that the camera's field of view is known.
  void addFrame() {
    for (const double x : {-320.0, 319.0}) {
      for (const double y : {-180.0, 179.0}) addPixel(x, y, kNoTrack, maker_.randomDescriptor());
    }
  }

  Descriptor randomDescriptor() { return maker_.randomDescriptor(); }
  Descriptor flipped(const Descriptor& descriptor, int bits) {
    return maker_.flipped(descriptor, bits);
  }

  ImageFeatures& features() { return features_; }
  FrameView& view() {
    if (stale_) view_.reset(features_, T_map_cam_, planar_);
    stale_ = false;
    return view_;
  }

 private:
  int addBearing(const Eigen::Vector3d& bearing, std::uint32_t track_id,
                 const Descriptor& descriptor) {
    features_.pixel_px.emplace_back(0.F, 0.F);  // not used behind the tracker
    features_.bearing_cam.push_back(bearing.cast<float>());
    features_.score.push_back(1);
    features_.track_id.push_back(track_id);
    features_.age_frames.push_back(0);
    features_.descriptor.push_back(descriptor);
    stale_ = true;
    return static_cast<int>(features_.size()) - 1;
  }

  PointWorld maker_;
  std::int64_t stamp_ns_ = 0;
  bool planar_ = false;
  bool stale_ = true;
  Eigen::Isometry3d T_map_cam_ = Eigen::Isometry3d::Identity();
  ImageFeatures features_;
  FrameView view_;
};

}  // namespace ardrone_vslam::test
