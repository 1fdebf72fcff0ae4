// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

enum class Suppression { kLocalClimb, kStrict3x3 };
template <>
struct EnumNames<Suppression> {
  static constexpr std::array<const char*, 2> kNames{"climb", "strict"};
};

struct CornerDetectorConfig {
  int arc_length_px = 12;
  int threshold = 35;
  int sampling_passes = 16;
  Suppression suppression = Suppression::kLocalClimb;
  int features_per_frame = 1000;
  int cell_size_px = 80;
  bool adapt_threshold = true;
  int threshold_min = 8;
  int threshold_max = 120;
};

template <class Visitor>
void visitParameters(CornerDetectorConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"arc_length_px", "px", 9, 12,
                      "contiguous circle pixels that make a corner (FAST-9..12)"},
        c.arc_length_px);
  visit(ParameterInfo{"threshold", "grey", 1, 254,
                      "grey-level difference of a circle pixel; the start value when it adapts"},
        c.threshold);
  visit(ParameterInfo{"sampling_passes", "passes", 1, 16,
                      "pixels tested in each 4x4 block; 16 finds every corner"},
        c.sampling_passes);
  visit(ParameterInfo{"suppression", "choice", 0, 0,
                      "climb: to the local maximum, found even when unsampled; strict: 3x3"},
        c.suppression);
  visit(ParameterInfo{"features_per_frame", "corners", 1, 20000,
                      "corner budget, spread over the image cells"},
        c.features_per_frame);
  visit(ParameterInfo{"cell_size_px", "px", 16, 4096,
                      "side of the cells that share the budget and adapt their threshold"},
        c.cell_size_px);
  visit(ParameterInfo{"adapt_threshold", "switch", 0, 0,
                      "let each cell's threshold keep its corner count in a band"},
        c.adapt_threshold);
  visit(
      ParameterInfo{"threshold_min", "grey", 1, 254, "lowest threshold that adaptation may choose"},
      c.threshold_min);
  visit(ParameterInfo{"threshold_max", "grey", 1, 254,
                      "highest threshold that adaptation may choose"},
        c.threshold_max);
}

/// FAST-s corners (algorithm.md 1, 2; thesis 3.1-3.6), thinned by non-maximum suppression and
/// spread over the image.
class CornerDetector {
 public:
  /// @throws ConfigError listing every invalid parameter.
  explicit CornerDetector(const CornerDetectorConfig& config);
  ~CornerDetector();

  /// Detects the corners of one image, in raster order of their position, no two equal. At most
  /// `features_per_frame`, the strongest of each cell first; a cell's unused share goes to the
  /// others. Pixels closer than 3 to the border are never corners. With `adapt_threshold` the
  /// thresholds used depend on the images before.
  void detect(const ImageView& image, std::vector<Corner>& corners);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
