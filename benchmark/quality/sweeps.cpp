// SPDX-License-Identifier: BSD-3-Clause
#include "sweeps.hpp"

#include <Eigen/LU>
#include <functional>

#include "feature_methods.hpp"
#include "picture_changes.hpp"

namespace ardrone_vslam::quality {
namespace {

struct Sweep {
  std::string name;
  std::string axis;
  std::vector<double> steps;
  double neutral;  ///< the step that changes nothing
  std::function<ChangedPicture(const cv::Mat&, double)> change;
};

using Steps = std::vector<double>;

Steps allAngles() {
  Steps steps;
  for (int angle_deg = 0; angle_deg <= 360; angle_deg += 15) steps.push_back(angle_deg);
  return steps;
}

std::vector<Sweep> makeSweeps(bool quick) {
  return {
      {"rotation", "turned by [deg]", quick ? Steps{0, 30, 90, 180} : allAngles(), 0, turned},
      {"scale", "scaled by",
       quick ? Steps{0.5, 0.8, 1, 2}
             : Steps{0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.1, 1.25, 1.4, 1.6, 1.8, 2},
       1, scaled},
      {"blur", "Gaussian blur, sigma [px]",
       quick ? Steps{0, 1, 2} : Steps{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}, 0, blurred},
  };
}

Eigen::Vector2d sizeOf(const cv::Mat& image) {
  return {image.cols, image.rows};
}

/// Both on the same canvas: what a method does at other sizes of the image is no matter of the
/// change.
std::vector<PairMetrics> sweepPicture(FeatureMethod& method, const cv::Mat& picture,
                                      const Sweep& sweep) {
  const ChangedPicture original = sweep.change(picture, sweep.neutral);
  const FeatureSet a = method.extract(original.view);
  std::vector<PairMetrics> points;
  for (const double step : sweep.steps) {
    const ChangedPicture changed = sweep.change(picture, step);
    const FeatureSet b = method.extract(changed.view);
    const PairGeometry geometry =
        planeGeometry(changed.H_changed_picture * original.H_changed_picture.inverse(),
                      sizeOf(original.view.image), sizeOf(changed.view.image));
    points.push_back(PairTruth(a.pixel_px, b.pixel_px, geometry).measure(matchFeatures(a, b)));
  }
  return points;
}

Curve meanCurve(const std::string& method, const std::vector<std::vector<PairMetrics>>& pictures) {
  Curve curve{method, {}};
  for (std::size_t step = 0; step < pictures.front().size(); ++step) {
    std::vector<PairMetrics> pairs;
    for (const auto& points : pictures) pairs.push_back(points[step]);
    curve.points.push_back(meanOf(pairs));
  }
  return curve;
}

Chart runSweep(const Sweep& sweep, const SourceImages& source, int budget) {
  Chart chart{sweep.name, sweep.axis, sweep.steps, {}};
  for (const auto& method : makeAllMethods(budget, Roll::kKnown)) {
    std::vector<std::vector<PairMetrics>> pictures;
    for (const auto& picture : source.images) {
      pictures.push_back(sweepPicture(*method, picture, sweep));
    }
    chart.curves.push_back(meanCurve(method->name(), pictures));
  }
  return chart;
}

}  // namespace

std::vector<Chart> runSweeps(const SourceImages& source, int budget, bool quick) {
  std::vector<Chart> charts;
  for (const auto& sweep : makeSweeps(quick)) charts.push_back(runSweep(sweep, source, budget));
  return charts;
}

}  // namespace ardrone_vslam::quality
