// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <optional>

#include "corners/corner_detector.hpp"
#include "feature_methods.hpp"
#include "freak/freak.hpp"

namespace ardrone_vslam::quality {
namespace {

CornerDetectorConfig cornerConfig(const FastFreakSettings& settings) {
  CornerDetectorConfig config;
  config.arc_length_px = settings.arc_length_px;
  config.threshold = settings.threshold;
  config.sampling_passes = settings.sampling_passes;
  config.adapt_threshold = false;
  config.features_per_frame = 20000;  // the budget is applied to what could be described
  config.cell_size_px = 4096;
  return config;
}

class FastFreak : public FeatureMethod {
 public:
  FastFreak(const FastFreakSettings& settings, std::string name)
      : name_(std::move(name)),
        budget_(static_cast<std::size_t>(settings.budget)),
        roll_known_(settings.roll_known),
        detector_(cornerConfig(settings)),
        describer_(FreakConfig()) {}

  std::string name() const override { return name_; }

  FeatureSet extract(const View& view) override {
    const ImageView image{view.image.data, view.image.cols, view.image.rows,
                          static_cast<std::ptrdiff_t>(view.image.step[0])};
    detector_.detect(image, corners_);
    if (!view.mask.empty()) {
      const auto isMasked = [&](const Corner& corner) {
        return view.mask.at<std::uint8_t>(corner.y_px, corner.x_px) == 0;
      };
      corners_.erase(std::remove_if(corners_.begin(), corners_.end(), isMasked), corners_.end());
    }
    keypoints_.clear();
    for (const Corner& corner : corners_) keypoints_.push_back({corner.x_px, corner.y_px});
    std::optional<float> orientation_rad;
    if (roll_known_) orientation_rad = static_cast<float>(view.rotation_rad);
    describer_.describe(image, keypoints_, described_, descriptors_, nullptr, orientation_rad);
    return strongest();
  }

 private:
  FeatureSet strongest() const {
    const auto scoreOf = [this](std::size_t i) {
      return corners_[static_cast<std::size_t>(described_[i])].score;
    };
    std::vector<std::size_t> order(described_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return scoreOf(i) > scoreOf(j); });
    order.resize(std::min(order.size(), budget_));

    FeatureSet features;
    for (const std::size_t i : order) {
      const auto& keypoint = keypoints_[static_cast<std::size_t>(described_[i])];
      features.pixel_px.emplace_back(keypoint.x_px, keypoint.y_px);
      features.descriptors.push_back(descriptors_[i]);
    }
    return features;
  }

  std::string name_;
  std::size_t budget_;
  bool roll_known_;
  CornerDetector detector_;
  FreakDescriber describer_;
  std::vector<Corner> corners_;
  std::vector<FreakKeypoint> keypoints_;
  std::vector<int> described_;
  std::vector<Descriptor> descriptors_;
};

}  // namespace

std::unique_ptr<FeatureMethod> makeFastFreak(const FastFreakSettings& settings,
                                             const std::string& name) {
  return std::make_unique<FastFreak>(settings, name);
}

std::vector<std::unique_ptr<FeatureMethod>> makeAllMethods(int budget, Roll roll) {
  std::vector<std::unique_ptr<FeatureMethod>> methods;
  FastFreakSettings settings;
  settings.budget = budget;
  methods.push_back(makeFastFreak(settings, "FAST-12 + FREAK"));
  if (roll == Roll::kKnown) {
    settings.roll_known = true;
    methods.push_back(makeFastFreak(settings, "FAST-12 + FREAK, roll known"));
    settings.roll_known = false;
  }
  settings.arc_length_px = 9;
  methods.push_back(makeFastFreak(settings, "FAST-9 + FREAK"));
  for (auto& peer : makePeers(budget)) methods.push_back(std::move(peer));
  return methods;
}

}  // namespace ardrone_vslam::quality
