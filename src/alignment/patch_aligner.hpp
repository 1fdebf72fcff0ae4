// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "alignment/patch.hpp"
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
  /// What a track keeps of the image that it is compared with.
  struct Reference {
    Surroundings surroundings;
    std::optional<kernels::AlignPatch> patch;
    Eigen::Vector2f offset_px = Eigen::Vector2f::Zero();  // of the track's point from the patch's
    float variance_px2 = 0;  // of that point beside the track's first corner
    int failures = 0;        // in a row
    ViewChange change;       // of the view, from the surroundings to the image before
    ViewChange applied;      // of it, in the patch and the offset
    bool is_new = true;      // of this image
  };

  std::size_t freeReference();
  /// Tracks that have ended give theirs back.
  void takeOver(const std::vector<int>& previous_of);
  /// From the image before to this one.
  void measureChange(const std::vector<int>& previous_of, const ImageFeatures& features);
  static void turnTo(const ViewChange& change, Reference& reference);
  void begin(const ImageView& image, const Eigen::Vector2f& corner_px, Reference& reference) const;
  void goOn(const ImageView& image, std::size_t feature, Reference& reference,
            ImageFeatures& features) const;

  const CameraModel& camera_;
  decltype(kernels::Kernels::align) align_;
  std::vector<Reference> references_;  // in no order
  std::vector<std::size_t> free_;      // places in it
  std::vector<std::size_t> before_;    // place of each feature's, in the image before
  std::vector<std::size_t> now_;
  std::vector<Eigen::Vector2f> before_px_;  // the features of the image before
  std::vector<TrackMove> moves_;
  ViewChange change_;  // of the last two images
};

}  // namespace ardrone_vslam
