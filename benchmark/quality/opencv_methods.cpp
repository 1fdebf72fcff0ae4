// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <opencv2/features2d.hpp>

#include "feature_methods.hpp"

namespace ardrone_vslam::quality {
namespace {

constexpr int kFastThreshold = 8;  // as for our corners
constexpr int kBriskThreshold = 15;
constexpr float kAkazeThreshold = 1e-4F;

Descriptor padded(const cv::Mat& descriptors, int row) {
  Descriptor descriptor;
  const auto bytes = std::min(sizeof(descriptor.words), static_cast<std::size_t>(descriptors.cols));
  assert(static_cast<std::size_t>(descriptors.cols) == bytes && "a descriptor of at most 512 bits");
  std::memcpy(descriptor.words.data(), descriptors.ptr(row), bytes);
  return descriptor;
}

class OpenCvMethod : public FeatureMethod {
 public:
  OpenCvMethod(cv::Ptr<cv::Feature2D> method, std::string name, int budget)
      : method_(std::move(method)),
        name_(std::move(name)),
        budget_(static_cast<std::size_t>(budget)) {}

  std::string name() const override { return name_; }

  FeatureSet extract(const View& view) override {
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    method_->detectAndCompute(view.image, view.mask, keypoints, descriptors);
    std::vector<std::size_t> order(keypoints.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return keypoints[i].response > keypoints[j].response;
    });
    order.resize(std::min(order.size(), budget_));
    FeatureSet features;
    for (const std::size_t i : order) {
      features.pixel_px.emplace_back(keypoints[i].pt.x, keypoints[i].pt.y);
      features.descriptors.push_back(padded(descriptors, static_cast<int>(i)));
    }
    return features;
  }

 private:
  cv::Ptr<cv::Feature2D> method_;
  std::string name_;
  std::size_t budget_;
};

}  // namespace

std::vector<std::unique_ptr<FeatureMethod>> makePeers(int budget) {
  const auto orb =
      cv::ORB::create(budget, 1.2F, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, kFastThreshold);
  const auto akaze = cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, kAkazeThreshold);
  std::vector<std::unique_ptr<FeatureMethod>> peers;
  peers.push_back(std::make_unique<OpenCvMethod>(orb, "cv::ORB", budget));
  peers.push_back(
      std::make_unique<OpenCvMethod>(cv::BRISK::create(kBriskThreshold), "cv::BRISK", budget));
  peers.push_back(std::make_unique<OpenCvMethod>(akaze, "cv::AKAZE", budget));
  return peers;
}

}  // namespace ardrone_vslam::quality
