// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "ardrone_vslam/instruction_set.hpp"
#include "ardrone_vslam/tracker_config.hpp"

namespace ardrone_vslam {

/// Where and how large to describe. `size_px` 7 is the pattern's own scale (OpenCV's keypoint
/// size): it then covers 45 x 45 pixels. A size s enlarges it by s / 7, in 64 steps of 2^(1 / 16).
struct FreakKeypoint {
  int x_px = 0;         ///< column of the pattern's centre
  int y_px = 0;         ///< row
  float size_px = 7.F;  ///< 7 .. 107, see above
};

/// Keypoints of size 7 at least so far from the left and upper border, and one pixel less from the
/// others, can be described.
constexpr int kFreakBorder_px = 24;

/// 512-bit FREAK (Alahi, Ortiz, Vandergheynst 2012), bit for bit the descriptor of OpenCV contrib's
/// FREAK with its default pattern (scale 22, 4 octaves, scale normalised); thesis
/// ch. 4. Bits run coarse to fine: the first 128 compare the outer fields. Random pairs of real
/// images differ in a median of 215 bits. Own code: the drone has no OpenCV, and Debian no other
/// descriptor of 512 bits.
///
/// About 111 KB of tables, computed at construction (59 KB of them are used at the pattern's own
/// size), plus one integral image of the frame: 2 bytes
/// a pixel for keypoints of the pattern's own size, 4 for larger ones. Its buffer is kept, so later
/// frames of the same size do not allocate. An object is not for use from two threads at once.
class FreakDescriber {
 public:
  /// @param set  one of supportedInstructionSets(); the descriptors do not depend on it
  explicit FreakDescriber(const FreakConfig& config,
                          InstructionSet set = instructionSetInUse().set);
  ~FreakDescriber();

  /// Describes the keypoints whose pattern fits into the image; at size 7 those at least 24 px from
  /// the left and upper border (23 < x < width - 23, rows alike). Cost: one pass over the image,
  /// then the same for each keypoint.
  /// @param keypoints  any order, also outside the image; sizes below 7 px are taken as 7, above
  /// 107 px as 107
  /// @param kept  indices into `keypoints` of those described, ascending; the others are too close
  /// to the border
  /// @param descriptors  descriptor k belongs to keypoints[kept[k]]
  /// @param angles_deg  when not null: the estimated orientation of each described keypoint,
  /// -180..180, from the image's x axis towards its y axis (clockwise as seen); 0 when upright
  /// @param orientation_rad  when given, the orientation of all keypoints, in the same sense and in
  /// place of the estimate: by how much the scene appears turned clockwise, which is minus the
  /// camera's roll about its viewing direction. Cheaper and steadier than the estimate; must be
  /// finite. Rounded to 1 / 256 of a turn
  void describe(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
                std::vector<int>& kept, std::vector<Descriptor>& descriptors,
                std::vector<float>* angles_deg = nullptr,
                std::optional<float> orientation_rad = std::nullopt);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
