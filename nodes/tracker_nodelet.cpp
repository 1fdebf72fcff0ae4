// SPDX-License-Identifier: BSD-3-Clause
#include "tracker_nodelet.hpp"

#include <ardrone_vslam/Features.h>
#include <cv_bridge/cv_bridge.h>
#include <image_transport/camera_common.h>
#include <image_transport/image_transport.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "conversions.hpp"
#include "debug_image.hpp"
#include "image_topics.hpp"
#include "params.hpp"
#include "track_ids.hpp"

namespace ardrone_vslam {
void TrackerNodelet::onInit() {
  readParameters();
  next_track_id_ = firstTrackId(ros::WallTime::now().toNSec());
  features_pub_ = getNodeHandle().advertise<Features>(
      "features", static_cast<std::uint32_t>(node_config_.queue_size));
  transport_ = std::make_unique<image_transport::ImageTransport>(getNodeHandle());
  debug_pub_ = transport_->advertise("debug_image", 1);
  diagnostics_ = std::make_unique<diagnostic_updater::Updater>(getNodeHandle(),
                                                               getPrivateNodeHandle(), getName());
  diagnostics_->setHardwareID("none");
  diagnostics_->add("tracker", this, &TrackerNodelet::diagnose);
  timer_ = getNodeHandle().createWallTimer(ros::WallDuration(1.0),
                                           [this](const ros::WallTimerEvent&) { onSecond(); });
  subscribe();
}

void TrackerNodelet::readParameters() {
  ParamReader reader(getPrivateNodeHandle());
  reader.read(node_config_);
  reader.read(config_);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    // Some faults lie between parameters: a tracker for any camera tells them now, not in mid-air.
    CameraIntrinsics any_camera;
    any_camera.width_px = 640;
    any_camera.height_px = 480;
    any_camera.fx_px = any_camera.fy_px = 500;
    any_camera.cx_px = 320;
    any_camera.cy_px = 240;
    Tracker(config_, any_camera);
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " tracker: " << reader.summary());
}

void TrackerNodelet::subscribe() {
  ros::NodeHandle& nh = getNodeHandle();
  const auto queue_size = static_cast<std::uint32_t>(node_config_.queue_size);
  const bool is_compressed = node_config_.image_transport == ImageTransport::kCompressed;
  const std::string base_topic = nh.resolveName("image");
  image_topic_ = is_compressed ? base_topic + "/compressed" : base_topic;
  // ROS's convention: beside the image, unless camera_info is remapped.
  info_topic_ = nh.resolveName("camera_info");
  if (info_topic_ == nh.resolveName("camera_info", false)) {
    info_topic_ = image_transport::getCameraInfoTopic(base_topic);
  }
  info_.registerCallback(boost::function<void(const sensor_msgs::CameraInfoConstPtr&)>(
      [this](const sensor_msgs::CameraInfoConstPtr&) { ++infos_; }));
  info_.subscribe(nh, info_topic_, queue_size);
  if (is_compressed) {
    using sensor_msgs::CompressedImage;
    compressed_.registerCallback(boost::function<void(const sensor_msgs::CompressedImageConstPtr&)>(
        [this](const sensor_msgs::CompressedImageConstPtr&) { ++images_; }));
    compressed_sync_ = std::make_unique<
        message_filters::TimeSynchronizer<CompressedImage, sensor_msgs::CameraInfo>>(
        compressed_, info_, queue_size);
    compressed_sync_->registerCallback(&TrackerNodelet::onImage<CompressedImage>, this);
    compressed_.subscribe(nh, image_topic_, queue_size);
  } else {
    using sensor_msgs::Image;
    raw_.registerCallback(boost::function<void(const sensor_msgs::ImageConstPtr&)>(
        [this](const sensor_msgs::ImageConstPtr&) { ++images_; }));
    raw_sync_ = std::make_unique<message_filters::TimeSynchronizer<Image, sensor_msgs::CameraInfo>>(
        raw_, info_, queue_size);
    raw_sync_->registerCallback(&TrackerNodelet::onImage<Image>, this);
    raw_.subscribe(*transport_, image_topic_, queue_size, image_transport::TransportHints("raw"));
  }
  NODELET_INFO_STREAM("images from " << image_topic_ << ", calibration from " << info_topic_);
}

template <class Message>
void TrackerNodelet::onImage(const boost::shared_ptr<const Message>& message,
                             const sensor_msgs::CameraInfoConstPtr& info) {
  if (!acceptStamp(message->header)) return;
  const GreyImage image = toGrey(message);
  if (!image.fault.empty()) return drop(image_topic_, image.fault);
  if (!prepareTracker(*info, message->header.frame_id, image)) return;
  tracker_->process(image.view(), toNanoseconds(message->header.stamp), features_,
                    stage_clock_.hook());
  next_track_id_ = tracker_->nextTrackId();
  publish(image, message->header);
}

bool TrackerNodelet::acceptStamp(const std_msgs::Header& header) {
  if (header.stamp.isZero()) {
    drop(image_topic_, "its stamp is zero; the driver must set header.stamp");
    return false;
  }
  switch (stamps_.check(toNanoseconds(header.stamp))) {
    case StampGuard::Answer::kNotAfter:
      drop(image_topic_, "its stamp is not after the one before; stamps must ascend");
      return false;
    case StampGuard::Answer::kRestart:
      NODELET_WARN_STREAM("stamps on " << image_topic_ << " jumped back to " << header.stamp
                                       << " (a bag plays again?): tracks begin anew");
      tracker_.reset();
      return true;
    case StampGuard::Answer::kAscending:
      return true;
  }
  return true;
}

bool TrackerNodelet::prepareTracker(const sensor_msgs::CameraInfo& info, const std::string& frame,
                                    const GreyImage& image) {
  const auto checked = toIntrinsics(info, node_config_.rectified);
  if (!checked.value) {
    drop(info_topic_, checked.fault);
    return false;
  }
  const CameraIntrinsics& camera = *checked.value;
  if (camera.width_px != image.pixels.cols || camera.height_px != image.pixels.rows) {
    drop(image_topic_, "its image is " + std::to_string(image.pixels.cols) + "x" +
                           std::to_string(image.pixels.rows) + " but " + info_topic_ + " is for " +
                           std::to_string(camera.width_px) + "x" +
                           std::to_string(camera.height_px) +
                           "; calibrate the camera at the size it streams");
    return false;
  }
  if (frame.empty()) {
    drop(image_topic_, "it names no frame_id; give the camera's optical frame");
    return false;
  }
  if (tracker_ && camera == camera_ && frame == camera_frame_) return true;
  if (tracker_) {
    NODELET_WARN_STREAM("the camera changed from " << camera_frame_ << " to " << frame
                                                   << ": tracks begin anew");
  }
  try {
    tracker_ = std::make_unique<Tracker>(config_, camera, next_track_id_);
  } catch (const std::invalid_argument& e) {
    tracker_.reset();
    drop(info_topic_, e.what());
    return false;
  }
  camera_ = camera;
  camera_frame_ = frame;
  return true;
}

void TrackerNodelet::publish(const GreyImage& image, const std_msgs::Header& header) {
  const auto message = boost::make_shared<Features>();
  toMessage(features_, camera_frame_, *message);
  message->header.stamp = header.stamp;
  for (std::size_t i = 0; i < message->stage_time.size(); ++i) {
    message->stage_time[i] = static_cast<float>(stage_clock_.milliseconds(static_cast<Stage>(i)));
  }
  message->images_dropped = dropped_;
  message->header.seq = static_cast<std::uint32_t>(++processed_);  // a gap tells of a lost message
  features_pub_.publish(FeaturesConstPtr(message));  // to const: no copy within the manager
  fault_.clear();
  if (debug_pub_.getNumSubscribers() == 0) return;
  const cv_bridge::CvImage drawn(header, sensor_msgs::image_encodings::BGR8,
                                 drawFeatures(image.pixels, features_));
  debug_pub_.publish(drawn.toImageMsg());
}

void TrackerNodelet::drop(const std::string& topic, const std::string& fault) {
  ++dropped_;
  fault_ = topic + ": " + fault;
  if (limiter_.allows(fault_, ros::SteadyTime::now().toSec())) {
    NODELET_WARN_STREAM("image dropped (" << dropped_ << " so far): " << fault_);
  }
}

void TrackerNodelet::onSecond() {
  const bool has_images = images_ != images_before_;
  const bool has_infos = infos_ != infos_before_;
  const bool has_answers = processed_ + dropped_ != processed_before_ + dropped_before_;
  rate_hz_ = static_cast<double>(processed_ - processed_before_);
  waiting_for_.clear();
  if (!has_images) {
    // check() first: getTopics() would wait for a master that is gone.
    if (isReminderDue(seconds_waiting_ + 1) && ros::master::check()) {
      ros::master::getTopics(published_);
    }
    waiting_for_ = adviceWithoutImages(image_topic_, published_);
  } else if (!has_infos) {
    waiting_for_ = "images on " + image_topic_ + " but no camera_info on " + info_topic_ +
                   ": calibrate the camera, or remap `camera_info`";
  } else if (!has_answers) {
    waiting_for_ = "images on " + image_topic_ + " and camera_info on " + info_topic_ +
                   " have no stamps in common: the driver must give both the same stamp";
  }
  seconds_waiting_ = waiting_for_.empty() ? 0 : seconds_waiting_ + 1;
  if (isReminderDue(seconds_waiting_)) NODELET_WARN_STREAM(waiting_for_);
  diagnostics_->force_update();
  processed_before_ = processed_;
  dropped_before_ = dropped_;
  images_before_ = images_;
  infos_before_ = infos_;
}

void TrackerNodelet::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!waiting_for_.empty()) {
    status.summary(DiagnosticStatus::WARN, waiting_for_);
  } else if (!fault_.empty()) {
    status.summary(DiagnosticStatus::ERROR, "images are dropped: " + fault_);
  } else {
    status.summary(DiagnosticStatus::OK, "tracking");
  }
  status.add("images per second", rate_hz_);
  status.add("images received", images_);
  status.add("images processed", processed_);
  status.add("images dropped", dropped_);
  status.add("features in the latest image", features_.size());
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::TrackerNodelet, nodelet::Nodelet)
