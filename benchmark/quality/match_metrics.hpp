// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace ardrone_vslam::quality {

/// How far apart two features may be and still show the same point, in pixels of the coarser image.
constexpr double kSamePoint_px = 2;
/// Features nearer to a border are not counted: some methods can describe them, others cannot.
constexpr double kBorder_px = 32;

/// Where a pixel of one image lies in another, also outside of it; nothing where the other camera
/// cannot see the point.
using PixelMap = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d& pixel_px)>;

/// What is known of two images of the same things.
struct PairGeometry {
  PixelMap a_to_b;
  PixelMap b_to_a;
  Eigen::Vector2d size_a_px;  ///< width, height
  Eigen::Vector2d size_b_px;
};

/// Geometry of a plane or of a turned, scaled or blurred picture. @param H  takes homogeneous
/// pixels of image a to image b
PairGeometry planeGeometry(const Eigen::Matrix3d& H_b_a, const Eigen::Vector2d& size_a_px,
                           const Eigen::Vector2d& size_b_px);

/// A feature of image a and one of image b that were taken for the same.
using IndexPair = std::pair<int, int>;

/// What one pair of images gave.
struct PairMetrics {
  int features = 0;           ///< in the common region; of the image that has fewer
  int matches = 0;            ///< in the whole images
  int correct = 0;            ///< of the matches
  double repeatability = 0;   ///< points found in both images / features (Mikolajczyk et al. 2005)
  double matching_score = 0;  ///< correct matches in the common region / features
  double precision = 0;       ///< correct / matches; 0 without matches
};

/// The features of two images beside the truth.
///
/// The common region is what both images show at least kBorder_px inside their borders. Two
/// features show the same point when one, taken to the other's image, is within kSamePoint_px of
/// it; the distance counts in that of the two images where it is smaller, so that a pixel of the
/// coarser image is the measure.
class PairTruth {
 public:
  PairTruth(const std::vector<Eigen::Vector2d>& a_px, const std::vector<Eigen::Vector2d>& b_px,
            const PairGeometry& geometry);

  bool isSamePoint(int a, int b) const;
  /// The greatest number of pairs that show the same point in the common region, each feature once.
  int countRepeated() const;
  PairMetrics measure(const std::vector<IndexPair>& matches) const;

 private:
  struct Feature {
    Eigen::Vector2d own_px;
    std::optional<Eigen::Vector2d> other_px;  // in the other image
    bool is_common = false;
  };
  static std::vector<Feature> place(const std::vector<Eigen::Vector2d>& pixels_px,
                                    const PixelMap& map, const Eigen::Vector2d& own_size_px,
                                    const Eigen::Vector2d& other_size_px);
  static bool isSame(const Feature& a, const Feature& b);

  std::vector<Feature> a_;
  std::vector<Feature> b_;
};

/// Mean of several pairs; counts are rounded. The empty mean is 0.
PairMetrics meanOf(const std::vector<PairMetrics>& pairs);

}  // namespace ardrone_vslam::quality
