// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_images.hpp"

#include <rosbag/view.h>

#include <stdexcept>

#include "bags/bag_poses.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/bag_read_message.hpp"
#include "bags/messages/grey_image.hpp"
#include "trajectory/ascent.hpp"

namespace ardrone_vslam {

struct BagImages::Counts {
  std::size_t stamps = 0;
  std::size_t incomplete = 0;
  std::size_t sizes = 0;
  std::string other_size;  // an example, and the calibration's
  std::size_t uncalibrated = 0;
  std::string uncalibrated_frame;  // an example
};

struct BagImages::Candidate {
  std_msgs::Header header;
  bool is_whole = false;
  cv::Size size_px;
};

namespace {

std::string text(const cv::Size& size_px) {
  return std::to_string(size_px.width) + "x" + std::to_string(size_px.height);
}

}  // namespace

BagImages::BagImages(const rosbag::Bag& bag, const ChosenTopics& topics, BagCameras& cameras,
                     BagFindings& findings)
    : place_(bag.getFileName() + ", " + topics.image), is_compressed_(topics.is_compressed) {
  Counts dropped;
  rosbag::View view(bag, rosbag::TopicQuery(topics.image));
  for (const rosbag::MessageInstance& instance : view) add(instance, cameras, dropped);
  putInOrder(dropped);
  report(dropped, findings);
}

BagImages::Candidate BagImages::inspect(const rosbag::MessageInstance& instance) const {
  Candidate candidate;
  if (is_compressed_) {
    const auto message = readMessage<sensor_msgs::CompressedImage>(instance);
    if (!message) return candidate;
    const cv::Mat image = greyImage(*message);
    candidate = {message->header, !image.empty(), image.size()};
  } else {
    const auto message = readMessage<sensor_msgs::Image>(instance);
    if (!message) return candidate;
    if (!isSupportedEncoding(message->encoding)) {
      throw std::runtime_error(place_ + ": the encoding '" + message->encoding +
                               "' is not supported; convert the images to one of " +
                               supportedEncodings());
    }
    const cv::Size size_px(static_cast<int>(message->width), static_cast<int>(message->height));
    candidate = {message->header, isWhole(*message), size_px};
  }
  return candidate;
}

void BagImages::add(const rosbag::MessageInstance& instance, BagCameras& cameras, Counts& dropped) {
  const Candidate candidate = inspect(instance);
  const std::int64_t stamp_ns = toNanoseconds(candidate.header.stamp);
  if (!candidate.is_whole) {
    ++dropped.incomplete;
    return;
  }
  const std::string frame = withoutSlash(candidate.header.frame_id);
  const auto which = cameras.find(frame);
  if (!which) {
    ++dropped.uncalibrated;
    dropped.uncalibrated_frame = frame;
    return;
  }
  const CameraIntrinsics& camera = cameras.intrinsics(*which);
  const cv::Size calibrated_px(camera.width_px, camera.height_px);
  if (candidate.size_px != calibrated_px) {
    ++dropped.sizes;
    dropped.other_size =
        text(candidate.size_px) + ", the calibration is for " + text(calibrated_px);
  } else if (stamp_ns <= 0) {
    ++dropped.stamps;
  } else {
    stamps_ns_.push_back(stamp_ns);
    camera_of_.push_back(*which);
    instances_.push_back(instance);
  }
}

void BagImages::putInOrder(Counts& dropped) {
  const std::vector<std::size_t> kept = longestAscent(stamps_ns_, Ascent::kStrict);
  dropped.stamps += stamps_ns_.size() - kept.size();
  keepAt(kept, stamps_ns_);
  keepAt(kept, camera_of_);
  keepAt(kept, instances_);
}

void BagImages::report(const Counts& dropped, BagFindings& findings) const {
  const std::size_t total = stamps_ns_.size() + dropped.incomplete + dropped.sizes +
                            dropped.uncalibrated + dropped.stamps;
  BagFindings found;
  found.lose(dropped.incomplete, total, place_,
             "images are incomplete or cannot be decoded; record them again");
  found.lose(dropped.sizes, total, place_,
             "images are unlike the calibration (" + dropped.other_size +
                 "); use the calibration made at the size of the images");
  found.lose(dropped.uncalibrated, total, place_,
             "images of the camera " + dropped.uncalibrated_frame +
                 " have no calibration; record the camera_info of that frame, too");
  found.lose(dropped.stamps, total, place_,
             "images have no stamp or one out of order; correct the driver's clock");
  if (stamps_ns_.empty()) {
    std::string all = place_ + ": no image can be used";
    if (found.warnings.empty()) all += ": the topic holds no message; record it again";
    for (const std::string& fault : found.warnings) all += ". " + fault;
    throw std::runtime_error(all);
  }
  findings.append(found);
}

cv::Mat BagImages::image(std::size_t index) const {
  const rosbag::MessageInstance& instance = instances_.at(index);
  cv::Mat image;
  if (is_compressed_) {
    if (const auto message = readMessage<sensor_msgs::CompressedImage>(instance)) {
      image = greyImage(*message);
    }
  } else if (const auto message = readMessage<sensor_msgs::Image>(instance)) {
    image = greyImage(*message);
  }
  if (image.empty()) {
    throw std::runtime_error(place_ + ": the image at " +
                             std::to_string(static_cast<double>(stamp_ns(index)) * 1e-9) +
                             " s cannot be read; the bag is damaged, record it again");
  }
  return image;
}

}  // namespace ardrone_vslam
