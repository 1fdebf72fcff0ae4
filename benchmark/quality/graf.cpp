// SPDX-License-Identifier: BSD-3-Clause
#include "graf.hpp"

#include "feature_methods.hpp"
#include "picture_changes.hpp"
#include "source_images.hpp"

namespace ardrone_vslam::quality {
namespace {

constexpr int kLastImage = 6;

}  // namespace

Chart runGraf(const std::string& folder, int budget) {
  Chart chart{"graf", "image", {}, {}};
  std::vector<cv::Mat> images;
  std::vector<Eigen::Matrix3d> homographies;
  for (int number = 1; number <= kLastImage; ++number) {
    const std::string text = std::to_string(number);
    images.push_back(readGrey(folder + "/img" + text + ".ppm"));
    if (number == 1) continue;
    homographies.push_back(readHomography(folder + "/H1to" + text + "p"));
    chart.x.push_back(number);
  }
  const auto sizeOf = [](const cv::Mat& image) { return Eigen::Vector2d(image.cols, image.rows); };
  for (const auto& method : makeAllMethods(budget, Roll::kUnknown)) {
    Curve curve{method->name(), {}};
    const FeatureSet first = method->extract(unchanged(images[0]).view);
    for (std::size_t i = 1; i < images.size(); ++i) {
      const FeatureSet other = method->extract(unchanged(images[i]).view);
      const PairGeometry geometry =
          planeGeometry(homographies[i - 1], sizeOf(images[0]), sizeOf(images[i]));
      const PairTruth truth(first.pixel_px, other.pixel_px, geometry);
      curve.points.push_back(truth.measure(matchFeatures(first, other)));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace ardrone_vslam::quality
