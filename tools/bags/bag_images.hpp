// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "bags/bag_cameras.hpp"
#include "bags/bag_findings.hpp"
#include "bags/bag_topics.hpp"

namespace ardrone_vslam {

/// The images of a topic that can be used. The pixels stay in the bag until they are asked for.
class BagImages {
 public:
  /// Images whose stamps are out of order, that are incomplete, of another size than their camera's
  /// calibration, or without one are left out; `findings` says how many. @pre the bag outlives the
  /// object
  /// @throws std::runtime_error when the encoding is not supported or no image is left
  BagImages(const rosbag::Bag& bag, const ChosenTopics& topics, BagCameras& cameras,
            BagFindings& findings);

  std::size_t size() const { return stamps_ns_.size(); }
  std::int64_t stamp_ns(std::size_t index) const { return stamps_ns_.at(index); }
  /// Which of the cameras took an image.
  std::size_t cameraOf(std::size_t index) const { return camera_of_.at(index); }
  /// 8-bit grey. @throws std::runtime_error naming topic and stamp
  cv::Mat image(std::size_t index) const;

 private:
  struct Counts;
  struct Candidate;
  Candidate inspect(const rosbag::MessageInstance& instance) const;
  void add(const rosbag::MessageInstance& instance, BagCameras& cameras, Counts& dropped);
  void putInOrder(Counts& dropped);
  void report(const Counts& dropped, BagFindings& findings) const;

  std::string place_;  // bag and topic, for messages
  bool is_compressed_;
  std::vector<rosbag::MessageInstance> instances_;
  std::vector<std::int64_t> stamps_ns_;
  std::vector<std::size_t> camera_of_;
};

}  // namespace ardrone_vslam
