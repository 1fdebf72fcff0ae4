// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>

#include "corners/corner_detector.hpp"
#include "measurements.hpp"
#include "picture_changes.hpp"
#include "pictures.hpp"
#include "timed.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr int kRounds = 5;
constexpr int kThreshold = 35;  // of ours: the thesis's
constexpr int kAllCorners = 100000;
// Table 3.5: how far a point is followed off. The thesis's source does not say from where to where.
constexpr double kRotation_deg = 4;
constexpr std::size_t kTracked = 500;
constexpr double kLost_px = 20;

using Points = std::vector<cv::Point2f>;

struct Detector {
  std::string name;
  std::string stands_for;  // of the thesis's tables
  std::function<Points(const cv::Mat&)> detect;
};

Detector peer(const std::string& name, const std::string& stands_for,
              const cv::Ptr<cv::Feature2D>& detector) {
  return {name, stands_for, [detector](const cv::Mat& image) {
            std::vector<cv::KeyPoint> keypoints;
            detector->detect(image, keypoints);
            cv::KeyPointsFilter::retainBest(keypoints, static_cast<int>(keypoints.size()));
            Points points;
            cv::KeyPoint::convert(keypoints, points);
            return points;
          }};
}

Detector ours(int arc_length_px) {
  CornerDetectorConfig config;
  config.arc_length_px = arc_length_px;
  config.threshold = kThreshold;
  config.adapt_threshold = false;
  config.features_per_frame = 20000;
  auto detector = std::make_shared<CornerDetector>(config);
  return {"FAST-" + std::to_string(arc_length_px) + " (this package)", "FAST",
          [detector](const cv::Mat& image) {
            std::vector<Corner> corners;
            detector->detect(viewOf(image), corners);
            Points points;
            for (const Corner& c : corners)
              points.emplace_back(static_cast<float>(c.x_px), static_cast<float>(c.y_px));
            return points;
          }};
}

/// Debian's OpenCV has neither SURF nor STAR. SIFT is, as SURF, a detector of blobs over a scale
/// space; AKAZE, as STAR, computes its scales in the full size.
std::vector<Detector> detectors(int fast_threshold) {
  return {ours(12),
          ours(9),
          peer("cv::FAST", "FAST", cv::FastFeatureDetector::create(fast_threshold, false)),
          peer("cv::SIFT", "SURF", cv::SIFT::create()),
          peer("cv::AKAZE", "STAR", cv::AKAZE::create()),
          peer("cv::MSER", "MSER", cv::MSER::create()),
          peer("cv::GFTT", "GFTT", cv::GFTTDetector::create())};
}

/// Errors of points followed by cv::calcOpticalFlowPyrLK into the turned picture.
void addTrackingErrors(const cv::Mat& picture, Points points, std::vector<double>& errors_px) {
  const quality::ChangedPicture from = quality::turned(picture, 0);
  const quality::ChangedPicture to = quality::turned(picture, kRotation_deg);
  if (points.size() > kTracked) points.resize(kTracked);
  if (points.empty()) return;
  const auto mapped = [](const Eigen::Matrix3d& H, const cv::Point2f& p) {
    const Eigen::Vector3d q = H * Eigen::Vector3d(p.x, p.y, 1);
    return cv::Point2f(static_cast<float>(q.x() / q.z()), static_cast<float>(q.y() / q.z()));
  };
  Points begin, found;
  for (const cv::Point2f& p : points) begin.push_back(mapped(from.H_changed_picture, p));
  std::vector<std::uint8_t> is_found;
  std::vector<float> unused;
  cv::calcOpticalFlowPyrLK(from.view.image, to.view.image, begin, found, is_found, unused);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double error_px = cv::norm(found[i] - mapped(to.H_changed_picture, points[i]));
    if (is_found[i] != 0 && error_px < kLost_px) errors_px.push_back(error_px);
  }
}

/// The thesis's source prints no threshold: that with which cv::FAST finds its number.
int thresholdFor(const cv::Mat& image, std::size_t wanted) {
  int best = 1;
  std::size_t least = image.total();
  for (int threshold = 1; threshold < 100; ++threshold) {
    std::vector<cv::KeyPoint> found;
    cv::FAST(image, found, threshold, false);
    const std::size_t off = found.size() > wanted ? found.size() - wanted : wanted - found.size();
    if (off < least) {
      least = off;
      best = threshold;
    }
  }
  return best;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? NAN : sum / static_cast<double>(values.size());
}

}  // namespace

nlohmann::json measureDetectors(bool quick) {
  constexpr std::size_t kMandrillCorners = 16947;  // table 3.1
  constexpr int kOpenCvThreshold = 10;             // its default
  const auto pictures = thesisPictures(quick);
  const int threshold = pictures[0].name == "mandrill"
                            ? thresholdFor(pictures[0].image, kMandrillCorners)
                            : kOpenCvThreshold;
  nlohmann::json json = {{"fast_threshold", threshold}, {"our_threshold", kThreshold}};
  const auto all = detectors(threshold);
  std::vector<std::vector<double>> errors_px(all.size());
  for (const NamedPicture& picture : pictures) {
    std::vector<TimedMethod> methods;
    for (const Detector& d : all)
      methods.push_back({d.name, [&](std::size_t) { return d.detect(picture.image).size(); }});
    const auto timings = timeMethods(methods, 1, quick ? 1 : kRounds);
    for (std::size_t i = 0; i < all.size(); ++i) {
      addTrackingErrors(picture.image, all[i].detect(picture.image), errors_px[i]);
      json["pictures"][picture.name][all[i].name] = {{"count", timings[i].mean_count},
                                                     {"time_ms", timings[i].time_ms}};
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    json["detectors"].push_back({{"name", all[i].name},
                                 {"stands_for", all[i].stands_for},
                                 {"tracking_error_px", meanOf(errors_px[i])},
                                 {"tracked", errors_px[i].size()}});
  return json;
}

}  // namespace ardrone_vslam::reproduction
