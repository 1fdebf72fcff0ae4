// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/features2d.hpp>

#include "corners/corner_detector.hpp"
#include "freak/freak.hpp"
#include "measurements.hpp"
#include "pictures.hpp"
#include "timed.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr int kRounds = 9;
constexpr int kBudget = 600;
constexpr float kKeypointSize_px = 7;

using Pictures = std::vector<NamedPicture>;
using Keypoints = std::vector<std::vector<cv::KeyPoint>>;  // of each picture

std::shared_ptr<CornerDetector> ourCorners() {
  CornerDetectorConfig config;
  config.features_per_frame = kBudget;
  return std::make_shared<CornerDetector>(config);
}

Keypoints cornersOf(const Pictures& pictures) {
  Keypoints keypoints;
  for (const NamedPicture& picture : pictures) {
    std::vector<Corner> corners;
    ourCorners()->detect(viewOf(picture.image), corners);
    keypoints.emplace_back();
    for (const Corner& c : corners)
      keypoints.back().emplace_back(static_cast<float>(c.x_px), static_cast<float>(c.y_px),
                                    kKeypointSize_px);
  }
  return keypoints;
}

TimedMethod ours(const std::string& name, const Pictures& pictures, const Keypoints& keypoints,
                 InstructionSet set) {
  auto describer = std::make_shared<FreakDescriber>(FreakConfig(), set);
  return {name, [=, &pictures, &keypoints](std::size_t i) {
            std::vector<FreakKeypoint> points;
            for (const cv::KeyPoint& k : keypoints[i])
              points.push_back({static_cast<int>(k.pt.x), static_cast<int>(k.pt.y)});
            std::vector<int> kept;
            std::vector<Descriptor> descriptors;
            describer->describe(viewOf(pictures[i].image), points, kept, descriptors);
            return kept.size();
          }};
}

TimedMethod peer(const std::string& name, const Pictures& pictures, const Keypoints& keypoints,
                 const cv::Ptr<cv::Feature2D>& describer) {
  return {name, [=, &pictures, &keypoints](std::size_t i) {
            auto kept = keypoints[i];  // compute() takes out those near the border
            cv::Mat descriptors;
            describer->compute(pictures[i].image, kept, descriptors);
            return kept.size();
          }};
}

TimedMethod both(const std::string& name, const Pictures& pictures,
                 const cv::Ptr<cv::Feature2D>& detector, const cv::Ptr<cv::Feature2D>& describer) {
  return {name, [=, &pictures](std::size_t i) {
            std::vector<cv::KeyPoint> keypoints;
            cv::Mat descriptors;
            if (detector == describer) {
              detector->detectAndCompute(pictures[i].image, cv::noArray(), keypoints, descriptors);
            } else {
              detector->detect(pictures[i].image, keypoints);
              describer->compute(pictures[i].image, keypoints, descriptors);
            }
            return keypoints.size();
          }};
}

/// Our FREAK at another detector's places.
TimedMethod withOurFreak(const std::string& name, const Pictures& pictures,
                         const cv::Ptr<cv::Feature2D>& detector) {
  auto describer = std::make_shared<FreakDescriber>(FreakConfig());
  return {name, [=, &pictures](std::size_t i) {
            std::vector<cv::KeyPoint> keypoints;
            detector->detect(pictures[i].image, keypoints);
            std::vector<FreakKeypoint> points;
            for (const cv::KeyPoint& k : keypoints)
              points.push_back({cvRound(k.pt.x), cvRound(k.pt.y)});
            std::vector<int> kept;
            std::vector<Descriptor> descriptors;
            describer->describe(viewOf(pictures[i].image), points, kept, descriptors);
            return kept.size();
          }};
}

TimedMethod ourFrontEnd(const Pictures& pictures, InstructionSet set, const std::string& name) {
  CornerDetectorConfig config;
  config.features_per_frame = kBudget;
  auto detector = std::make_shared<CornerDetector>(config, set);
  auto describer = std::make_shared<FreakDescriber>(FreakConfig(), set);
  return {name, [=, &pictures](std::size_t i) {
            const ImageView view = viewOf(pictures[i].image);
            std::vector<Corner> corners;
            detector->detect(view, corners);
            std::vector<FreakKeypoint> points;
            for (const Corner& c : corners) points.push_back({c.x_px, c.y_px});
            std::vector<int> kept;
            std::vector<Descriptor> descriptors;
            describer->describe(view, points, kept, descriptors);
            return kept.size();
          }};
}

nlohmann::json timesOf(const std::vector<TimedMethod>& methods, std::size_t pictures, bool quick) {
  const auto timings = timeMethods(methods, pictures, quick ? 1 : kRounds);
  nlohmann::json json = nlohmann::json::array();
  for (std::size_t m = 0; m < methods.size(); ++m)
    json.push_back({{"name", methods[m].name},
                    {"features", timings[m].mean_count},
                    {"time_ms", timings[m].time_ms},
                    {"feature_time_us", timings[m].time_ms * 1e3 / timings[m].mean_count}});
  return json;
}

}  // namespace

nlohmann::json measureDescriptors(bool quick) {
  const Pictures pictures = thesisPictures(quick);
  const Keypoints keypoints = cornersOf(pictures);
  const InstructionSet best = instructionSetInUse().set;
  const auto sift = cv::SIFT::create();
  const auto brisk = cv::BRISK::create();
  const auto orb = cv::ORB::create(kBudget);
  const auto fast = cv::FastFeatureDetector::create(35);
  return {
      {"features", kBudget},
      {"descriptors",
       timesOf({peer("SIFT (cv::SIFT)", pictures, keypoints, sift),
                peer("BRISK (cv::BRISK)", pictures, keypoints, brisk),
                peer("ORB (cv::ORB)", pictures, keypoints, orb),
                ours("FREAK, scalar (this package)", pictures, keypoints, InstructionSet::kScalar),
                ours("FREAK (this package)", pictures, keypoints, best)},
               pictures.size(), quick)},
      {"front_ends",
       timesOf({both("SIFT/SIFT", pictures, sift, sift), both("SIFT/BRISK", pictures, sift, brisk),
                withOurFreak("SIFT/FREAK", pictures, sift),
                both("FAST/BRISK", pictures, fast, brisk), both("ORB/ORB", pictures, orb, orb),
                ourFrontEnd(pictures, InstructionSet::kScalar, "FAST/FREAK, scalar (this package)"),
                ourFrontEnd(pictures, best, "FAST/FREAK (this package)")},
               pictures.size(), quick)}};
}

}  // namespace ardrone_vslam::reproduction
