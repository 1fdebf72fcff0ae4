// SPDX-License-Identifier: BSD-3-Clause
// What the tracker says of itself: warnings, diagnostics.
#include "inputs/image_topics.hpp"
#include "tracker/tracker_nodelet.hpp"

namespace ardrone_vslam {

void TrackerNodelet::drop(const std::string& topic, const std::string& fault) {
  ++dropped_;
  fault_ = topic + ": " + fault;
  if (limiter_.allows(fault_, ros::SteadyTime::now().toSec())) {
    NODELET_WARN_STREAM("image dropped (" << dropped_ << " so far): " << fault_);
  }
}

void TrackerNodelet::onSecond() {
  const ImageQueue::Counts counts = queue_->counts();
  rate_hz_ = static_cast<double>(processed_ - processed_before_);
  waiting_for_ = missing(counts);
  seconds_waiting_ = waiting_for_.empty() ? 0 : seconds_waiting_ + 1;
  if (isReminderDue(seconds_waiting_)) NODELET_WARN_STREAM(waiting_for_);
  warnOfLosses(counts);
  diagnostics_->force_update();
  processed_before_ = processed_;
  counts_before_ = counts;
}

std::string TrackerNodelet::missing(const ImageQueue::Counts& counts) {
  if (counts.images == counts_before_.images) {
    // check() first: getTopics() would wait for a master that is gone.
    if (isReminderDue(seconds_waiting_ + 1) && ros::master::check()) {
      ros::master::getTopics(published_);
    }
    return adviceWithoutImages(image_topic_, published_);
  }
  if (counts.infos == counts_before_.infos) {
    return "images on " + image_topic_ + " but no camera_info on " + info_topic_ +
           ": calibrate the camera, or remap `camera_info`";
  }
  if (counts.paired == counts_before_.paired) {
    return "images on " + image_topic_ + " and camera_info on " + info_topic_ +
           " have no stamps in common: the driver must give both the same stamp";
  }
  return {};
}

void TrackerNodelet::warnOfLosses(const ImageQueue::Counts& counts) {
  loss_.clear();
  std::uint64_t so_far = 0;
  if (counts.overflowed > counts_before_.overflowed) {
    so_far = counts.overflowed;
    loss_ = "images on " + image_topic_ +
            " come faster than the tracker works, the oldest are dropped: lower the camera's rate "
            "or size, or features_per_frame; for a bag raise queue_size or play "
            "slower";
  } else if (counts.without_info > counts_before_.without_info && counts_before_.paired > 0) {
    // Those before the first camera_info are none of the user's business once it comes.
    so_far = counts.without_info;
    loss_ = "some images on " + image_topic_ + " have no camera_info with their stamp on " +
            info_topic_ + ": the driver must publish one with each image";
  }
  if (!loss_.empty() && limiter_.allows(loss_, ros::SteadyTime::now().toSec())) {
    NODELET_WARN_STREAM(loss_ << " (" << so_far << " lost so far)");
  }
}

void TrackerNodelet::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!waiting_for_.empty()) {
    status.summary(DiagnosticStatus::WARN, waiting_for_);
  } else if (!fault_.empty()) {
    status.summary(DiagnosticStatus::ERROR, "images are dropped: " + fault_);
  } else if (!loss_.empty()) {
    status.summary(DiagnosticStatus::WARN, loss_);
  } else {
    status.summary(DiagnosticStatus::OK, "tracking");
  }
  const ImageQueue::Counts counts = queue_->counts();
  status.add("images per second", rate_hz_);
  status.add("images received", counts.images);
  status.add("images processed", processed_);
  status.add("images dropped", dropped_);
  status.add("images dropped while the tracker was busy", counts.overflowed);
  status.add("images without camera_info", counts.without_info);
  status.add("images waiting", counts.waiting);
  if (attitude_) status.add("images without attitude", attitude_->imagesWithout());
  status.add("features in the latest image", features_.size());
}

}  // namespace ardrone_vslam
