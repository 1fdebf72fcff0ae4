// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "match_metrics.hpp"

namespace ardrone_vslam::quality {

/// The features of one image, the strongest first.
struct FeatureSet {
  std::vector<Eigen::Vector2d> pixel_px;
  std::vector<Descriptor> descriptors;  ///< shorter ones end in zeros, which changes no distance
};

/// An image as a method gets it.
struct View {
  cv::Mat image;  ///< 8-bit grey
  cv::Mat mask;   ///< features lie where it is not 0; empty: everywhere
  double rotation_rad =
      0;  ///< by how much the scene is turned clockwise; for methods that are told
};

/// A detector with its descriptor.
class FeatureMethod {
 public:
  virtual ~FeatureMethod() = default;

  virtual std::string name() const = 0;
  virtual FeatureSet extract(const View& view) = 0;
};

/// Our corners with our FREAK. One cell and a fixed threshold, so that the strongest corners of the
/// whole image are kept, as the peers do.
struct FastFreakSettings {
  int arc_length_px = 12;
  int threshold = 8;  ///< the lowest that the tracker's adaptation may choose
  int sampling_passes = 16;
  bool roll_known = false;  ///< describe by the view's turn, not by each corner's own orientation
  int budget = 500;         ///< features of an image, the strongest
};
std::unique_ptr<FeatureMethod> makeFastFreak(const FastFreakSettings& settings,
                                             const std::string& name);

/// cv::ORB, cv::BRISK and cv::AKAZE, with thresholds so low that they fill the budget.
std::vector<std::unique_ptr<FeatureMethod>> makePeers(int budget);

enum class Roll { kUnknown, kKnown };

/// FAST-12 and FAST-9 with FREAK, then the peers.
/// @param roll  kKnown: also FAST-12 with FREAK that is told the turn of the views
std::vector<std::unique_ptr<FeatureMethod>> makeAllMethods(int budget, Roll roll);

/// Nearest descriptors with the tracker's ratio test and cross check, and without its limit of the
/// distance: how large distances are is different for each descriptor.
std::vector<IndexPair> matchFeatures(const FeatureSet& a, const FeatureSet& b);

}  // namespace ardrone_vslam::quality
