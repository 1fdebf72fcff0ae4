// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// Where and how large to describe. `size_px` 7 is the pattern's own scale (OpenCV's keypoint
/// size).
struct FreakKeypoint {
  int x_px = 0;
  int y_px = 0;
  float size_px = 7.F;
};

struct FreakConfig {
  bool oriented = true;
};

template <class Visitor>
void visitParameters(FreakConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"oriented", "switch", 0, 0,
                      "turn the pattern by the patch's own orientation (45 pairs); off: upright"},
        c.oriented);
}

/// 512-bit FREAK (Alahi, Ortiz, Vandergheynst 2012), bit for bit the descriptor of OpenCV contrib's
/// FREAK with its default pattern (scale 22, 4 octaves, scale normalised); algorithm.md 3, thesis
/// ch. 4.
class FreakDescriber {
 public:
  explicit FreakDescriber(const FreakConfig& config);
  ~FreakDescriber();

  /// Describes the keypoints whose pattern fits into the image.
  /// @param kept  indices into `keypoints` of those described, ascending; the others are too close
  /// to the border
  /// @param descriptors  descriptor k belongs to keypoints[kept[k]]
  /// @param angles_deg  when not null: the estimated orientation of each described keypoint,
  /// -180..180; 0 when upright
  void describe(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
                std::vector<int>& kept, std::vector<Descriptor>& descriptors,
                std::vector<float>* angles_deg = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
