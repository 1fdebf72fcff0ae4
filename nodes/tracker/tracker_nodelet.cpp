// SPDX-License-Identifier: BSD-3-Clause
#include "tracker/tracker_nodelet.hpp"

#include <ardrone_vslam/Features.h>
#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "ardrone_vslam/instruction_set.hpp"
#include "conversions/conversions.hpp"
#include "outputs/debug_image.hpp"
#include "with_ros/params.hpp"

namespace ardrone_vslam {

void TrackerNodelet::onInit() {
  readParameters();
  ros::NodeHandle& nh = getNodeHandle();
  features_pub_ =
      nh.advertise<Features>("features", static_cast<std::uint32_t>(node_config_.queue_size));
  debug_pub_ = image_transport::ImageTransport(nh).advertise("debug_image", 1);
  if (config_.use_attitude)
    attitude_ = std::make_unique<AttitudeInput>(nh, node_config_.image_time_offset_s);
  images_ = std::make_unique<ImageReceiver>(
      nh, getSTCallbackQueue(), node_config_,
      [this](const AnyImage& image, const sensor_msgs::CameraInfo& info) { onImage(image, info); });
  NODELET_INFO_STREAM("images from " << images_->imageTopic() << ", calibration from "
                                     << images_->infoTopic());
  tracker_ = std::make_unique<LiveTracker>(node_config_, config_, *images_, warnings_);
  changes_ = std::make_unique<ParameterChanges<TrackerChanges>>(
      getPrivateNodeHandle(), TrackerChanges{config_.corners, config_.tracks}, warnings_,
      [this](const TrackerChanges& changes) { tracker_->change(changes); });
  status_ = std::make_unique<TrackerStatus>(
      nh, getPrivateNodeHandle(), getName(),
      TrackerStatus::Parts{*images_, *tracker_, *changes_, attitude_.get()}, warnings_);
  timers_.every(nh, 1.0, [this] { status_->endSecond(); });
  images_->start();  // last: callbacks run at once, in another thread
}

void TrackerNodelet::readParameters() {
  ParamReader reader(getPrivateNodeHandle());
  reader.read(node_config_);
  reader.read(config_);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    // Some faults lie between parameters: a tracker for any camera tells them now, not in mid-air.
    Tracker(config_, anyCamera());
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " tracker: "
                      << reader.summary() << "; kernels: " << nameOf(instructionSetInUse().set));
  if (!instructionSetInUse().fault.empty()) NODELET_WARN_STREAM(instructionSetInUse().fault);
}

void TrackerNodelet::onImage(const AnyImage& message, const sensor_msgs::CameraInfo& info) {
  const std_msgs::Header& header = message.header();
  std::string fault = stampFault(header);
  if (!fault.empty()) return status_->drop(images_->imageTopic() + ": " + fault);
  const GreyImage image = toGrey(message);
  if (!image.fault.empty()) return status_->drop(images_->imageTopic() + ": " + image.fault);
  fault = tracker_->prepare(info, header.frame_id, image);
  if (!fault.empty()) return status_->drop(fault);
  tracker_->process(image, toNanoseconds(header.stamp), rotation_rad(header));
  publish(image, header);
}

std::string TrackerNodelet::stampFault(const std_msgs::Header& header) {
  if (header.stamp.isZero()) return "its stamp is zero; the driver must set header.stamp";
  switch (stamps_.check(toNanoseconds(header.stamp))) {
    case StampGuard::Answer::kNotAfter:
      return "its stamp is not after the one before; stamps must ascend";
    case StampGuard::Answer::kAlone:
      return kAloneFault;
    case StampGuard::Answer::kRestart:
      warnings_.event(text("stamps on ", images_->imageTopic(), " jumped back to ", header.stamp,
                           " (a bag plays again?): tracks begin anew"));
      tracker_->reset();
      break;
    case StampGuard::Answer::kAscending:
      break;
  }
  return {};
}

std::optional<float> TrackerNodelet::rotation_rad(const std_msgs::Header& header) {
  if (!attitude_) return std::nullopt;
  const auto rotation_rad =
      attitude_->imageRoll_rad(toNanoseconds(header.stamp), tracker_->cameraFrame());
  if (!rotation_rad)
    warnings_.limited("attitude",
                      attitude_->fault() + "; until then each corner's own orientation");
  return rotation_rad;
}

void TrackerNodelet::publish(const GreyImage& image, const std_msgs::Header& header) {
  const auto message = boost::make_shared<Features>();
  toMessage(tracker_->features(), tracker_->cameraFrame(), *message);
  message->header.stamp = header.stamp;
  for (std::size_t i = 0; i < message->stage_time.size(); ++i) {
    message->stage_time[i] = static_cast<float>(tracker_->milliseconds(static_cast<Stage>(i)));
  }
  message->images_dropped = status_->dropped();
  const ImageQueue::Counts counts = images_->counts();
  message->images_dropped_queue = counts.overflowed;
  message->images_without_camera_info = counts.without_info;
  message->changed_parameters = changes_->changed();
  // A gap tells of a lost message.
  message->header.seq = static_cast<std::uint32_t>(status_->countProcessed());
  features_pub_.publish(FeaturesConstPtr(message));  // to const: no copy within the manager
  if (debug_pub_.getNumSubscribers() == 0) return;
  const cv_bridge::CvImage drawn(header, sensor_msgs::image_encodings::BGR8,
                                 drawFeatures(image.pixels, tracker_->features()));
  debug_pub_.publish(drawn.toImageMsg());
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::TrackerNodelet, nodelet::Nodelet)
