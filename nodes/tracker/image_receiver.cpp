// SPDX-License-Identifier: BSD-3-Clause
#include "tracker/image_receiver.hpp"

#include <image_transport/camera_common.h>

#include <boost/make_shared.hpp>
#include <utility>

namespace ardrone_vslam {

class ImageReceiver::Work : public ros::CallbackInterface {
 public:
  explicit Work(ImageReceiver& receiver) : receiver_(receiver) {}
  CallResult call() override {
    receiver_.takeNext();
    return Success;
  }

 private:
  ImageReceiver& receiver_;
};

ImageReceiver::ImageReceiver(const ros::NodeHandle& nh, ros::CallbackQueueInterface& own_queue,
                             const TrackerNodeConfig& config, Take take)
    : own_queue_(own_queue),
      nh_(nh),
      is_compressed_(config.image_transport == ImageTransport::kCompressed),
      take_(std::move(take)),
      queue_(static_cast<std::size_t>(config.queue_size)),
      receiver_(1, &receive_queue_) {
  nh_.setCallbackQueue(&receive_queue_);
  const std::string base_topic = nh.resolveName("image");
  image_topic_ = is_compressed_ ? base_topic + "/compressed" : base_topic;
  // ROS's convention: beside the image, unless camera_info is remapped.
  info_topic_ = nh.resolveName("camera_info");
  if (info_topic_ == nh.resolveName("camera_info", false)) {
    info_topic_ = image_transport::getCameraInfoTopic(base_topic);
  }
}

ImageReceiver::~ImageReceiver() {
  receiver_.stop();  // no wake() after this
  own_queue_.removeByID(reinterpret_cast<std::uint64_t>(this));
}

void ImageReceiver::start() {
  // Without limit: the thread that receives does hardly more than count, so nothing piles up here.
  constexpr std::uint32_t kUnlimited = 0;
  // Else small messages like camera_info may be held back by 40 ms, and images wait for them.
  const auto hints = ros::TransportHints().tcpNoDelay();
  const auto on_info = [this](const sensor_msgs::CameraInfoConstPtr& info) {
    if (queue_.addInfo(info)) wake();
  };
  const auto on_raw = [this](const sensor_msgs::ImageConstPtr& image) {
    if (queue_.addImage({image, nullptr})) wake();
  };
  const auto on_compressed = [this](const sensor_msgs::CompressedImageConstPtr& image) {
    if (queue_.addImage({nullptr, image})) wake();
  };
  info_sub_ = nh_.subscribe<sensor_msgs::CameraInfo>(info_topic_, kUnlimited, on_info, {}, hints);
  if (is_compressed_) {
    image_sub_ = nh_.subscribe<sensor_msgs::CompressedImage>(image_topic_, kUnlimited,
                                                             on_compressed, {}, hints);
  } else {
    image_sub_ = nh_.subscribe<sensor_msgs::Image>(image_topic_, kUnlimited, on_raw, {}, hints);
  }
  receiver_.start();
}

void ImageReceiver::wake() {
  own_queue_.addCallback(boost::make_shared<Work>(*this), reinterpret_cast<std::uint64_t>(this));
}

void ImageReceiver::takeNext() {
  bool has_more = false;
  const auto next = queue_.take(has_more);
  if (has_more) wake();  // one at a time, so that the timers have their turn in between
  if (next) take_(next->image, *next->info);
}

}  // namespace ardrone_vslam
