// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/frame_result.hpp"

namespace ardrone_vslam {

/// `target` is the index of a landmark or map feature, `feature` of the frame's feature.
struct Association {
  int target = 0;   ///< index into LandmarkMap::all() or FeatureMap::all()
  int feature = 0;  ///< index into ImageFeatures
};

/// What one search found, before and after the removal of mismatches.
struct AssociationResult {
  std::vector<Association> matches;           ///< what is left after the removal of mismatches
  MatchMethod method = MatchMethod::kGuided;  ///< how it was looked for
  int in_view = 0;                            ///< targets that the prediction puts into the image
  int candidates = 0;                         ///< descriptor or track matches
  int mismatches = 0;                         ///< removed of them
  std::vector<int> missed;  ///< targets in view without a match; none unless guided

  /// Nothing was found yet. The lists keep their memory.
  void clear() {
    matches.clear();
    missed.clear();
    method = MatchMethod::kGuided;
    in_view = candidates = mismatches = 0;
  }
};

}  // namespace ardrone_vslam
