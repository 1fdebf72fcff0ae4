// SPDX-License-Identifier: BSD-3-Clause
#include "motions.hpp"

#include <cmath>
#include <functional>

#include "corners/corner_detector.hpp"
#include "feature_methods.hpp"
#include "frames.hpp"
#include "picture_changes.hpp"
#include "world/world_sequence.hpp"
#include "world_views.hpp"

namespace ardrone_vslam::quality {
namespace {

constexpr int kWidth_px = 568, kHeight_px = 320;
constexpr double kRate_hz = 30;
constexpr int kPasses[] = {1, 2, 4, 8, 16};
constexpr int kGaps[] = {1, 10};
constexpr int kNoBudget = 20000;

struct Motion {
  std::string name;
  std::function<Eigen::Isometry3d(double t_s)> T_world_cam;
};

/// Half a metre a second or so, as the drone flies indoors; a turn on the spot takes 10 s.
std::vector<Motion> makeMotions() {
  const auto phase = [](double t_s) { return 2 * M_PI * t_s / 5; };
  const auto lookAhead = [](double x_m, double y_m, double z_m) {
    return lookAlong(0, {x_m, y_m, z_m});
  };
  return {
      {"circle",
       [=](double t_s) {
         return lookAhead(0, 0.4 * std::cos(phase(t_s)), 1.4 + 0.4 * std::sin(phase(t_s)));
       }},
      {"to and fro", [=](double t_s) { return lookAhead(0.6 * std::sin(phase(t_s)), 0, 1.4); }},
      {"sideways", [=](double t_s) { return lookAhead(0, 0.6 * std::sin(phase(t_s)), 1.4); }},
      {"rotation",
       [](double t_s) {
         return lookAlong(2 * M_PI * t_s / 10, {0, 0, 1.4});
       }},
  };
}

/// The AR.Drone's front camera in the size of the thesis's videos.
CameraIntrinsics motionCamera() {
  return bench::resized(arDroneFrontCamera(), kWidth_px, kHeight_px);
}

/// A motion's images and where they were taken.
struct Video {
  std::vector<cv::Mat> images;
  std::vector<Eigen::Isometry3d> T_world_cam;
};

Video film(const WorldViews& world, const Motion& motion, int frames) {
  Video video;
  for (int i = 0; i < frames; ++i) {
    video.T_world_cam.push_back(motion.T_world_cam(i / kRate_hz));
    video.images.push_back(world.render(video.T_world_cam.back(), static_cast<std::uint64_t>(i)));
  }
  return video;
}

std::vector<FeatureSet> extractAll(FeatureMethod& method, const Video& video) {
  std::vector<FeatureSet> features;
  for (const auto& image : video.images) features.push_back(method.extract(unchanged(image).view));
  return features;
}

PairMetrics comparePairs(const WorldViews& world, const Video& video,
                         const std::vector<FeatureSet>& features, int gap) {
  std::vector<PairMetrics> pairs;
  for (std::size_t a = 0; a + static_cast<std::size_t>(gap) < features.size(); ++a) {
    const std::size_t b = a + static_cast<std::size_t>(gap);
    const PairGeometry geometry = world.geometry(video.T_world_cam[a], video.T_world_cam[b]);
    const PairTruth truth(features[a].pixel_px, features[b].pixel_px, geometry);
    pairs.push_back(truth.measure(matchFeatures(features[a], features[b])));
  }
  return meanOf(pairs);
}

Chart compareMethods(const WorldViews& world, const Video& video, const std::string& name,
                     int budget) {
  Chart chart{name, "frames apart", {std::begin(kGaps), std::end(kGaps)}, {}};
  for (const auto& method : makeAllMethods(budget, Roll::kKnown)) {
    const auto features = extractAll(*method, video);
    Curve curve{method->name(), {}};
    for (const int gap : kGaps) curve.points.push_back(comparePairs(world, video, features, gap));
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

Chart comparePasses(const WorldViews& world, const Video& video, const std::string& name) {
  Chart chart{name, "sampling passes", {std::begin(kPasses), std::end(kPasses)}, {}};
  for (const int arc_length_px : {12, 9}) {
    Curve curve{"FAST-" + std::to_string(arc_length_px) + " + FREAK", {}};
    for (const int passes : kPasses) {
      FastFreakSettings settings;
      settings.arc_length_px = arc_length_px;
      settings.threshold = CornerDetectorConfig().threshold;
      settings.sampling_passes = passes;
      settings.budget = kNoBudget;
      const auto method = makeFastFreak(settings, curve.method);
      curve.points.push_back(comparePairs(world, video, extractAll(*method, video), 1));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace

MotionCharts runMotions(int frames, int budget) {
  const WorldViews world(motionCamera());
  MotionCharts charts;
  for (const auto& motion : makeMotions()) {
    const Video video = film(world, motion, frames);
    charts.motions.push_back(compareMethods(world, video, motion.name, budget));
    charts.passes.push_back(comparePasses(world, video, motion.name));
  }
  return charts;
}

}  // namespace ardrone_vslam::quality
