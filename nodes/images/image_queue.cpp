// SPDX-License-Identifier: BSD-3-Clause
#include "images/image_queue.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

// Of small things. Image and camera_info come through connections of their own, either of which may
// be far ahead: roscpp reads one as long as it has data.
constexpr std::size_t kMany = 1000;

}  // namespace

ImageQueue::ImageQueue(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 1)) {}

bool ImageQueue::addImage(const AnyImage& image) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.images;
  const ros::Time stamp = image.header().stamp;
  const auto found = std::find_if(infos_.begin(), infos_.end(),
                                  [&](const auto& info) { return info->header.stamp == stamp; });
  if (found != infos_.end()) {
    const sensor_msgs::CameraInfoConstPtr info = *found;
    infos_.erase(infos_.begin(), found + 1);  // those before it belong to no image
    // Each topic comes in order: the images that still wait will get none any more.
    counts_.without_info += images_.size();
    images_.clear();
    given_up_.clear();
    return addPair(image, info);
  }
  images_.push_back(image);
  if (images_.size() > capacity_) {
    given_up_.push_back(images_.front().header().stamp);
    if (given_up_.size() > kMany) given_up_.pop_front();
    images_.pop_front();
    ++counts_.without_info;
  }
  return false;
}

bool ImageQueue::addInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.infos;
  const auto found = std::find_if(images_.begin(), images_.end(), [&](const AnyImage& image) {
    return image.header().stamp == info->header.stamp;
  });
  if (found != images_.end()) {
    const AnyImage image = *found;
    // As above: those before it will get none any more.
    counts_.without_info += static_cast<std::uint64_t>(found - images_.begin());
    images_.erase(images_.begin(), found + 1);
    given_up_.clear();
    return addPair(image, info);
  }
  const auto late = std::find(given_up_.begin(), given_up_.end(), info->header.stamp);
  if (late != given_up_.end()) {
    given_up_.erase(given_up_.begin(), late + 1);
    --counts_.without_info;
    ++counts_.overflowed;
    return false;
  }
  infos_.push_back(info);
  if (infos_.size() > std::max(kMany, capacity_)) infos_.pop_front();
  return false;
}

bool ImageQueue::addPair(const AnyImage& image, const sensor_msgs::CameraInfoConstPtr& info) {
  ++counts_.paired;
  pairs_.push_back({image, info});
  if (pairs_.size() > capacity_) {
    pairs_.pop_front();
    ++counts_.overflowed;
    return false;
  }
  return pairs_.size() == 1;
}

std::optional<ImageQueue::Pair> ImageQueue::take(bool& has_more) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_more = pairs_.size() > 1;
  if (pairs_.empty()) return std::nullopt;
  Pair pair = pairs_.front();
  pairs_.pop_front();
  return pair;
}

ImageQueue::Counts ImageQueue::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Counts counts = counts_;
  counts.waiting = pairs_.size() + images_.size();
  return counts;
}

}  // namespace ardrone_vslam
