// SPDX-License-Identifier: BSD-3-Clause
#include "tracker/tracker_nodelet.hpp"

#include <ardrone_vslam/Features.h>
#include <cv_bridge/cv_bridge.h>
#include <image_transport/camera_common.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "ardrone_vslam/instruction_set.hpp"
#include "conversions/conversions.hpp"
#include "from_ros/params.hpp"
#include "outputs/debug_image.hpp"
#include "tracker/track_ids.hpp"

namespace ardrone_vslam {

class TrackerNodelet::Work : public ros::CallbackInterface {
 public:
  explicit Work(TrackerNodelet& nodelet) : nodelet_(nodelet) {}
  CallResult call() override {
    nodelet_.processNext();
    return Success;
  }

 private:
  TrackerNodelet& nodelet_;
};

TrackerNodelet::~TrackerNodelet() {
  receiver_.reset();  // no wake() after this
  if (own_queue_ != nullptr) own_queue_->removeByID(reinterpret_cast<std::uint64_t>(this));
}

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
  if (config_.use_attitude)
    attitude_ = std::make_unique<AttitudeInput>(getNodeHandle(), node_config_.image_time_offset_s);
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
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " tracker: "
                      << reader.summary() << "; kernels: " << nameOf(instructionSetInUse().set));
  if (!instructionSetInUse().fault.empty()) NODELET_WARN_STREAM(instructionSetInUse().fault);
}

void TrackerNodelet::subscribe() {
  queue_ = std::make_unique<ImageQueue>(static_cast<std::size_t>(node_config_.queue_size));
  own_queue_ = &getSTCallbackQueue();
  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(&receive_queue_);
  const bool is_compressed = node_config_.image_transport == ImageTransport::kCompressed;
  const std::string base_topic = nh.resolveName("image");
  image_topic_ = is_compressed ? base_topic + "/compressed" : base_topic;
  // ROS's convention: beside the image, unless camera_info is remapped.
  info_topic_ = nh.resolveName("camera_info");
  if (info_topic_ == nh.resolveName("camera_info", false)) {
    info_topic_ = image_transport::getCameraInfoTopic(base_topic);
  }
  // Without limit: the thread that receives does hardly more than count, so nothing piles up here.
  constexpr std::uint32_t kUnlimited = 0;
  // Else small messages like camera_info may be held back by 40 ms, and images wait for them.
  const auto hints = ros::TransportHints().tcpNoDelay();
  const auto on_info = [this](const sensor_msgs::CameraInfoConstPtr& info) {
    if (queue_->addInfo(info)) wake();
  };
  const auto on_raw = [this](const sensor_msgs::ImageConstPtr& image) {
    if (queue_->addImage({image, nullptr})) wake();
  };
  const auto on_compressed = [this](const sensor_msgs::CompressedImageConstPtr& image) {
    if (queue_->addImage({nullptr, image})) wake();
  };
  info_sub_ = nh.subscribe<sensor_msgs::CameraInfo>(info_topic_, kUnlimited, on_info, {}, hints);
  if (is_compressed) {
    image_sub_ = nh.subscribe<sensor_msgs::CompressedImage>(image_topic_, kUnlimited, on_compressed,
                                                            {}, hints);
  } else {
    image_sub_ = nh.subscribe<sensor_msgs::Image>(image_topic_, kUnlimited, on_raw, {}, hints);
  }
  receiver_ = std::make_unique<ros::AsyncSpinner>(1, &receive_queue_);
  receiver_->start();
  NODELET_INFO_STREAM("images from " << image_topic_ << ", calibration from " << info_topic_);
}

void TrackerNodelet::wake() {
  own_queue_->addCallback(boost::make_shared<Work>(*this), reinterpret_cast<std::uint64_t>(this));
}

void TrackerNodelet::processNext() {
  bool has_more = false;
  const auto next = queue_->take(has_more);
  if (has_more) wake();  // one at a time, so that the timers have their turn in between
  if (next) onImage(next->image, *next->info);
}

void TrackerNodelet::onImage(const AnyImage& message, const sensor_msgs::CameraInfo& info) {
  const std_msgs::Header& header = message.header();
  if (!acceptStamp(header)) return;
  const GreyImage image = toGrey(message);
  if (!image.fault.empty()) return drop(image_topic_, image.fault);
  if (!prepareTracker(info, header.frame_id, image)) return;
  std::optional<float> rotation_rad;
  if (attitude_)
    rotation_rad = attitude_->imageRoll_rad(toNanoseconds(header.stamp), camera_frame_);
  if (attitude_ && !rotation_rad && limiter_.allows("attitude", ros::SteadyTime::now().toSec()))
    NODELET_WARN_STREAM(attitude_->fault() << "; until then each corner's own orientation");
  tracker_->process(image.view(), toNanoseconds(header.stamp), features_, stage_clock_.hook(),
                    rotation_rad);
  next_track_id_ = tracker_->nextTrackId();
  publish(image, header);
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
  const auto checked =
      toIntrinsics(info, {node_config_.rectified, node_config_.rescale_calibration});
  if (!checked.value) {
    drop(info_topic_, "camera " + frame + ": " + checked.fault);
    return false;
  }
  const CameraIntrinsics& camera = *checked.value;
  if (camera.width_px != image.pixels.cols || camera.height_px != image.pixels.rows) {
    drop(image_topic_, "camera " + frame + ": its image is " + std::to_string(image.pixels.cols) +
                           "x" + std::to_string(image.pixels.rows) + " but " + info_topic_ +
                           " is for " + std::to_string(camera.width_px) + "x" +
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
  const double scale = camera.fx_px / (node_config_.rectified ? info.P[0] : info.K[0]);
  if (scale != 1)
    NODELET_WARN_STREAM(info_topic_ << ": camera " << frame << ": the calibration is of images "
                                    << 1 / scale << " times as wide: taken for them "
                                    << "(rescale_calibration)");
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
  const ImageQueue::Counts counts = queue_->counts();
  message->images_dropped_queue = counts.overflowed;
  message->images_without_camera_info = counts.without_info;
  message->header.seq = static_cast<std::uint32_t>(++processed_);  // a gap tells of a lost message
  features_pub_.publish(FeaturesConstPtr(message));  // to const: no copy within the manager
  fault_.clear();
  if (debug_pub_.getNumSubscribers() == 0) return;
  const cv_bridge::CvImage drawn(header, sensor_msgs::image_encodings::BGR8,
                                 drawFeatures(image.pixels, features_));
  debug_pub_.publish(drawn.toImageMsg());
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::TrackerNodelet, nodelet::Nodelet)
