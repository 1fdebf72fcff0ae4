// SPDX-License-Identifier: BSD-3-Clause
#include "camera/camera_nodelet.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <chrono>
#include <pluginlib/class_list_macros.hpp>

#include "with_ros/params.hpp"

namespace ardrone_vslam {
namespace {

void pause_ms(int time_ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(time_ms));
}

/// "/front/image_raw" -> "/front".
std::string namespaceOf(const std::string& topic) {
  return topic.substr(0, std::max<std::size_t>(topic.rfind('/'), 1));
}

}  // namespace

CameraNodelet::~CameraNodelet() {
  ends_ = true;
  if (thread_.joinable()) thread_.join();
}

void CameraNodelet::onInit() {
  readParameters();
  ros::NodeHandle& nh = getNodeHandle();
  loadCalibration();
  try {
    open();
  } catch (const std::exception& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  images_ = image_transport::ImageTransport(nh).advertiseCamera("image_raw", 2);
  diagnostics_ =
      std::make_unique<diagnostic_updater::Updater>(nh, getPrivateNodeHandle(), getName());
  diagnostics_->setHardwareID(config_.device);
  diagnostics_->add("camera", this, &CameraNodelet::diagnose);
  timers_.every(nh, 1.0, [this] { diagnostics_->force_update(); });
  thread_ = std::thread([this] { run(); });
}

void CameraNodelet::readParameters() {
  ParamReader reader(getPrivateNodeHandle());
  reader.read(config_);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    if (ros::Time::isSimTime())
      throw ConfigError(
          {"/use_sim_time is set, but a camera goes by the computer's clock: "
           "rosparam set /use_sim_time false"});
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " camera: " << reader.summary());
}

void CameraNodelet::loadCalibration() {
  const std::string camera = namespaceOf(getNodeHandle().resolveName("image_raw"));
  const std::string name = camera == "/" ? "camera" : camera.substr(camera.rfind('/') + 1);
  const bool is_path = !config_.camera.empty() && config_.camera.front() == '/';
  calibration_ = std::make_unique<camera_info_manager::CameraInfoManager>(
      ros::NodeHandle(camera), name, (is_path ? "file://" : "") + config_.camera);
  if (!calibration_->isCalibrated())
    NODELET_WARN_STREAM(
        "the camera is not calibrated, so the tracker waits: docs/any_robot.md "
        "tells how; the parameter camera names a calibration that is there");
}

void CameraNodelet::open() {
  const sensor_msgs::CameraInfo info = calibration_->getCameraInfo();
  const cv::Size size(static_cast<int>(info.width), static_cast<int>(info.height));
  source_ = std::make_unique<VideoSource>(config_.device, size, config_.rate);
}

void CameraNodelet::run() {
  while (!ends_ && source_->isFile() && images_.getNumSubscribers() == 0) pause_ms(20);
  cv::Mat image;
  ros::Time stamp;
  while (!ends_) {
    if (source_ && source_->read(image, stamp)) {
      publish(image, stamp);
    } else if (source_ && source_->isFile()) {
      setFault("the video has ended");
      NODELET_INFO_STREAM(config_.device << " has ended after " << published_ << " images");
      return;
    } else {
      reopen();
    }
  }
}

void CameraNodelet::reopen() {
  if (source_) NODELET_ERROR_STREAM(config_.device << ": no more images come; it is tried again");
  source_.reset();
  try {
    open();
    setFault("");
    NODELET_INFO_STREAM(config_.device << " is there again");
  } catch (const std::exception& e) {
    setFault(e.what());
    for (int i = 0; i < 50 && !ends_; ++i) pause_ms(20);
  }
}

void CameraNodelet::publish(const cv::Mat& image, const ros::Time& stamp) {
  if (images_.getNumSubscribers() == 0) return;
  sensor_msgs::CameraInfo info = calibrationOf(image);
  info.header.stamp = stamp;
  info.header.frame_id = config_.camera_frame;
  const auto* encoding = image.channels() == 1 ? "mono8" : "bgr8";
  images_.publish(cv_bridge::CvImage(info.header, encoding, image).toImageMsg(),
                  boost::make_shared<sensor_msgs::CameraInfo>(info));
  ++published_;
}

sensor_msgs::CameraInfo CameraNodelet::calibrationOf(const cv::Mat& image) {
  sensor_msgs::CameraInfo info = calibration_->getCameraInfo();
  const auto width_px = static_cast<std::uint32_t>(image.cols);
  const auto height_px = static_cast<std::uint32_t>(image.rows);
  if (info.width == width_px && info.height == height_px) return info;
  if (calibration_->isCalibrated())
    NODELET_WARN_STREAM_THROTTLE(
        5, "the calibration is for " << info.width << "x" << info.height << " but images are "
                                     << width_px << "x" << height_px << ": calibrate at this size");
  info = {};
  info.width = width_px;
  info.height = height_px;
  return info;
}

void CameraNodelet::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!fault_.empty())
    status.summary(DiagnosticStatus::ERROR, fault_);
  else if (!calibration_->isCalibrated())
    status.summary(DiagnosticStatus::WARN, "not calibrated");
  else
    status.summary(DiagnosticStatus::OK, "streaming");
  status.add("images published", published_.load());
}

void CameraNodelet::setFault(const std::string& fault) {
  const std::lock_guard<std::mutex> lock(mutex_);
  fault_ = fault;
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::CameraNodelet, nodelet::Nodelet)
