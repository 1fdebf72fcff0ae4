// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ardrone_vslam {

/// Root of what is known of a measured ray's direction [1/rad], axes of the rig: of unit noise is
/// root * (true - measured). Its rows lie across the ray.
using RayRoot = Eigen::Matrix<double, 2, 3>;

/// One view of a point by a frame of the window.
struct TrackView {
  std::size_t frame = 0;                                   ///< index into WindowState::frames()
  Eigen::Vector3d bearing_rig = Eigen::Vector3d::UnitX();  ///< measured unit ray, axes of the rig
  RayRoot root_rig = RayRoot::Zero();
};

/// The views of one track, ascending in the frame, that somebody else holds.
class TrackViews {
 public:
  TrackViews() = default;
  /// @param first  of `count` views in a row, which must outlive this
  TrackViews(const TrackView* first, std::size_t count) : first_(first), count_(count) {}
  /// All of a vector, which must outlive this.
  // NOLINTNEXTLINE(google-explicit-constructor): a vector is one
  TrackViews(const std::vector<TrackView>& views) : TrackViews(views.data(), views.size()) {}

  /// Number of views.
  std::size_t size() const { return count_; }
  /// The oldest view.
  const TrackView* begin() const { return first_; }
  /// Behind the newest view.
  const TrackView* end() const { return first_ + count_; }
  /// The oldest view. @pre there is one
  const TrackView& front() const { return *first_; }
  /// The newest view. @pre there is one
  const TrackView& back() const { return *(end() - 1); }

 private:
  const TrackView* first_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace ardrone_vslam
