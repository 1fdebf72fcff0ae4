// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "alignment/patch_references.hpp"
#include "alignment/view_change.hpp"
#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "kernels/kernels.hpp"

namespace ardrone_vslam {

/// Gives tracks positions between pixels: what the image showed around a track's first corner is
/// looked for, by its grey levels, around the corner that goes on with the track, else that stays.
class PatchAligner {
 public:
  /// @param camera  must outlive this
  explicit PatchAligner(const CameraModel& camera)
      : camera_(camera), align_(kernels::kernelsInUse().align) {}

  /// Makes room for so many features, so that align() does not allocate.
  void reserve(std::size_t features);

  /// Moves the features of tracks that go on: pixel, bearing, information and residual. All lie as
  /// far inside the image as FREAK needs it. @param previous_of  FrameTracker::assign()
  void align(const ImageView& image, const std::vector<int>& previous_of, ImageFeatures& features);

 private:
  /// From the image before to this one.
  void measureChange(const std::vector<int>& previous_of, const ImageFeatures& features);
  void goOn(const ImageView& image, std::size_t feature, ImageFeatures& features);

  const CameraModel& camera_;
  decltype(kernels::Kernels::align) align_;
  PatchReferences references_;
  std::vector<Eigen::Vector2f> before_px_;  // the features of the image before
  std::vector<TrackMove> moves_;
  ViewChange change_ = kSameView;  // of the last two images
};

}  // namespace ardrone_vslam
