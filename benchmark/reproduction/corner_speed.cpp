// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "arc_corners.hpp"
#include "corners/corner_detector.hpp"
#include "kernels/fast/fast_kernels.hpp"
#include "measurements.hpp"
#include "pictures.hpp"
#include "timed.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr int kRounds = 5;
constexpr int kThreshold = 35;

using Images = std::vector<cv::Mat>;

/// A part of the video in another size.
Images videoOf(const Images& video, const cv::Size& size) {
  Images images;
  for (const cv::Mat& image : video) {
    images.emplace_back();
    cv::resize(image, images.back(), size, 0, 0, cv::INTER_CUBIC);
  }
  return images;
}

TimedMethod ours(const std::string& name, const Images& images, int arc_length_px,
                 InstructionSet set) {
  CornerDetectorConfig config;
  config.arc_length_px = arc_length_px;
  config.threshold = kThreshold;
  config.adapt_threshold = false;
  config.suppression = Suppression::kStrict3x3;
  config.features_per_frame = 20000;
  auto detector = std::make_shared<CornerDetector>(config, set);
  auto corners = std::make_shared<std::vector<Corner>>();
  return {name, [=, &images](std::size_t i) {
            detector->detect(viewOf(images[i]), *corners);
            return corners->size();
          }};
}

TimedMethod peer(const std::string& name, const Images& images,
                 const cv::Ptr<cv::Feature2D>& detector) {
  return {name, [=, &images](std::size_t i) {
            std::vector<cv::KeyPoint> keypoints;
            detector->detect(images[i], keypoints);
            return keypoints.size();
          }};
}

nlohmann::json pixelRates(const Images& images, bool quick) {
  const InstructionSet best = instructionSetInUse().set;
  const std::vector<TimedMethod> methods = {
      ours("FAST-9, scalar (this package)", images, 9, InstructionSet::kScalar),
      ours("FAST-12, scalar (this package)", images, 12, InstructionSet::kScalar),
      ours("FAST-9 (this package)", images, 9, best),
      ours("FAST-12 (this package)", images, 12, best),
      {"FAST-12 by definition, no initial test",
       [&](std::size_t i) { return arcCorners(images[i], 12, kThreshold).size(); }},
      peer("cv::FAST 9_16", images, cv::FastFeatureDetector::create(kThreshold)),
      peer("cv::AGAST 9_16", images, cv::AgastFeatureDetector::create(kThreshold))};
  const auto timings = timeMethods(methods, images.size(), quick ? 1 : kRounds);
  nlohmann::json json = nlohmann::json::array();
  for (std::size_t m = 0; m < methods.size(); ++m)
    json.push_back(
        {{"name", methods[m].name},
         {"corners", timings[m].mean_count},
         {"time_ms", timings[m].time_ms},
         {"mpx_per_s_time", static_cast<double>(images[0].total()) / timings[m].time_ms * 1e-3}});
  return json;
}

/// The thesis's own FAST: initial test, its order of pixels, one pixel at a time, no suppression.
std::size_t countProposed(const cv::Mat& image, int arc_length_px, int threshold) {
  const auto circle =
      kernels::fastCircle(static_cast<std::ptrdiff_t>(image.step[0]), arc_length_px);
  constexpr int kBorder = kernels::kCircleRadiusPx;
  std::size_t count = 0;
  for (int y = kBorder; y < image.rows - kBorder; ++y)
    for (int x = kBorder; x < image.cols - kBorder; ++x)
      if (kernels::fastTestScalar(image.ptr(y) + x, circle, threshold)) ++count;
  return count;
}

/// Time against corners, 320x240, without suppression: thresholds from many corners to few.
nlohmann::json timeAgainstCorners(const Images& video, bool quick) {
  nlohmann::json json;
  for (const int threshold : {8, 12, 16, 20, 25, 30, 35, 45, 60}) {
    std::vector<TimedMethod> methods;
    for (const int s : {9, 11, 12})
      methods.push_back({"proposed FAST-" + std::to_string(s), [&, s, threshold](std::size_t i) {
                           return countProposed(video[i], s, threshold);
                         }});
    methods.push_back({"FAST-12 by definition", [&, threshold](std::size_t i) {
                         return static_cast<std::size_t>(countArcCorners(video[i], 12, threshold));
                       }});
    methods.push_back({"cv::FAST 9_16", [&, threshold](std::size_t i) {
                         std::vector<cv::KeyPoint> keypoints;
                         cv::FAST(video[i], keypoints, threshold, false);
                         return keypoints.size();
                       }});
    const auto timings = timeMethods(methods, video.size(), quick ? 1 : kRounds);
    for (std::size_t m = 0; m < methods.size(); ++m)
      json[methods[m].name].push_back({{"threshold", threshold},
                                       {"corners", timings[m].mean_count},
                                       {"time_ms", timings[m].time_ms}});
  }
  return json;
}

}  // namespace

nlohmann::json measureCornerSpeed(bool quick) {
  std::string what;
  const Images video = smallVideo(quick ? 4 : 12, what);
  return {{"what", what},
          {"sizes",
           {{"992x668", pixelRates(videoOf(video, {992, 668}), quick)},
            {"352x288", pixelRates(videoOf(video, {352, 288}), quick)}}},
          {"against_corners", timeAgainstCorners(video, quick)}};
}

}  // namespace ardrone_vslam::reproduction
