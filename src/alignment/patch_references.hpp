// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "alignment/patch.hpp"
#include "alignment/view_change.hpp"
#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam {

/// What a track keeps of the image that it is compared with.
struct PatchReference {
  Surroundings surroundings;
  std::optional<kernels::AlignPatch> patch;  ///< of the surroundings, if they have structure
  bool is_to_be_made = true;                 ///< the patch: most tracks end before it is needed
  Eigen::Vector2f offset_px = Eigen::Vector2f::Zero();  ///< of the track's point from the patch's
  /// Of that point beside the track's first corner.
  Eigen::Matrix2f variance_px2 = Eigen::Matrix2f::Zero();
  int failures = 0;                ///< in a row
  ViewChange change = kSameView;   ///< of the view, from the surroundings to the image before
  ViewChange applied = kSameView;  ///< of it, in the patch and the offset
  bool is_new = true;              ///< of this image

  /// From now on the track is compared with this image. The point's variance stays.
  void begin(const ImageView& image, const Eigen::Vector2f& point_px);
  /// Makes the patch, and anew where the view has turned or grown by more since.
  void adaptTo(const ViewChange& change_since);
};

/// One for each track of an image. They stay in place as tracks go on.
class PatchReferences {
 public:
  /// Makes room for so many features, so that nothing allocates.
  void reserve(std::size_t features);
  /// Features that carry on a track get its reference; tracks that have ended give theirs back, and
  /// features that begin one get one. @param previous_of  FrameTracker::assign()
  void takeOver(const std::vector<int>& previous_of);
  PatchReference& operator[](std::size_t feature) { return references_[now_[feature]]; }

 private:
  std::vector<PatchReference> references_;  // in no order
  std::vector<std::size_t> free_;           // places in it
  std::vector<std::size_t> before_;         // place of each feature's, in the image before
  std::vector<std::size_t> now_;
};

}  // namespace ardrone_vslam
