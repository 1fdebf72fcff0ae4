// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/features_topic.hpp"

#include <utility>

namespace ardrone_vslam {

FeaturesTopic::FeaturesTopic(const ros::NodeHandle& nh, Warnings& warnings, Calls calls)
    : name_(nh.resolveName("features")), warnings_(warnings), calls_(std::move(calls)) {}

void FeaturesTopic::subscribe(ros::NodeHandle& nh, int queue_size) {
  subscriber_ = nh.subscribe("features", static_cast<std::uint32_t>(queue_size),
                             &FeaturesTopic::onFeatures, this);
}

void FeaturesTopic::onFeatures(const FeaturesConstPtr& features) {
  has_come_ = true;
  gaps_.see(features->header.seq);
  newest_ = features;
  if (accept(*features)) calls_.take(features);
}

bool FeaturesTopic::accept(const Features& features) {
  const std::string fault = faultOf(features);
  if (!fault.empty()) {
    ++dropped_bad_message_;
    warnings_.refuse(name(), fault);
    return false;
  }
  switch (stamps_.check(toNanoseconds(features.header.stamp))) {
    case StampGuard::Answer::kNotAfter:
      ++dropped_stamp_;
      warnings_.refuse(name(), "its stamp is not after the one before; stamps must ascend");
      return false;
    case StampGuard::Answer::kAlone:
      ++dropped_stamp_;
      warnings_.refuse(name(), kAloneFault);
      return false;
    case StampGuard::Answer::kRestart:
      calls_.restart(toNanoseconds(features.header.stamp));
      return true;
    case StampGuard::Answer::kAscending:
      return true;
  }
  return true;
}

bool FeaturesTopic::endSecond() {
  return std::exchange(has_come_, false);
}

void FeaturesTopic::fill(Status& status) const {
  if (newest_) {
    constexpr std::size_t kLongest = 1000;  // characters; a good tracker's are fewer
    status.images_dropped = newest_->images_dropped;
    status.images_dropped_queue = newest_->images_dropped_queue;
    status.images_without_camera_info = newest_->images_without_camera_info;
    status.changed_parameters = newest_->changed_parameters.substr(0, kLongest);
  }
  status.dropped_bad_message = dropped_bad_message_;
  status.dropped_stamp = dropped_stamp_;
  status.dropped_queue = gaps_.lost();
}

}  // namespace ardrone_vslam
