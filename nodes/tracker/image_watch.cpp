// SPDX-License-Identifier: BSD-3-Clause
#include "tracker/image_watch.hpp"

#include "images/image_topics.hpp"

namespace ardrone_vslam {

void ImageWatch::endSecond() {
  const ImageQueue::Counts counts = receiver_.counts();
  waiting_for_ = missing(counts);
  const bool waits = !clock_.endSecond() && !waiting_for_.empty();
  seconds_waiting_ = waits ? seconds_waiting_ + 1 : 0;
  const std::string clock_fault = clock_.fault();
  if (!clock_fault.empty()) warnings_.say(clock_fault);
  if (isReminderDue(seconds_waiting_)) warnings_.say(waiting_for_);
  warnOfLosses(counts);
  before_ = counts;
}

std::string ImageWatch::missing(const ImageQueue::Counts& counts) {
  const std::string& image_topic = receiver_.imageTopic();
  const std::string& info_topic = receiver_.infoTopic();
  if (counts.images == before_.images) {
    // check() first: getTopics() would wait for a master that is gone.
    if (isReminderDue(seconds_waiting_ + 1) && ros::master::check()) {
      ros::master::getTopics(published_);
    }
    return adviceWithoutImages(image_topic, published_);
  }
  if (counts.infos == before_.infos) {
    return "images on " + image_topic + " but no camera_info on " + info_topic +
           ": calibrate the camera, or remap `camera_info`";
  }
  if (counts.paired == before_.paired) {
    return "images on " + image_topic + " and camera_info on " + info_topic +
           " have no stamps in common: the driver must give both the same stamp";
  }
  return {};
}

void ImageWatch::warnOfLosses(const ImageQueue::Counts& counts) {
  loss_.clear();
  std::uint64_t so_far = 0;
  if (counts.overflowed > before_.overflowed) {
    so_far = counts.overflowed;
    loss_ = "images on " + receiver_.imageTopic() +
            " come faster than the tracker works, the oldest are dropped: lower the camera's rate "
            "or size, or features_per_frame; for a bag raise queue_size or play "
            "slower";
  } else if (counts.without_info > before_.without_info && before_.paired > 0) {
    // Those before the first camera_info are none of the user's business once it comes.
    so_far = counts.without_info;
    loss_ = "some images on " + receiver_.imageTopic() +
            " have no camera_info with their stamp on " + receiver_.infoTopic() +
            ": the driver must publish one with each image";
  }
  if (!loss_.empty())
    warnings_.limited(loss_, loss_ + " (" + std::to_string(so_far) + " lost so far)");
}

}  // namespace ardrone_vslam
