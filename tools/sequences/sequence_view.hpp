// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <utility>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// The image, left to right.
inline cv::Mat mirroredImage(const cv::Mat& image) {
  cv::Mat mirrored;
  cv::flip(image, mirrored, 1);
  return mirrored;
}

/// A sequence that is another one; what differs is overridden.
class SequenceView : public Sequence {
 public:
  explicit SequenceView(std::unique_ptr<Sequence> sequence) : sequence_(std::move(sequence)) {}

  std::string name() const override { return sequence_->name(); }
  std::size_t size() const override { return sequence_->size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return sequence_->stamp_ns(index); }
  cv::Mat image(std::size_t index) override { return sequence_->image(index); }
  const CameraIntrinsics& camera() const override { return sequence_->camera(); }
  Eigen::Isometry3d T_base_cam() const override { return sequence_->T_base_cam(); }
  std::size_t cameraOf(std::size_t index) const override { return sequence_->cameraOf(index); }
  SequenceCamera cameraAt(std::size_t which) const override { return sequence_->cameraAt(which); }
  const Trajectory& truth() const override { return sequence_->truth(); }
  const std::vector<OdometryState>& odometry() const override { return sequence_->odometry(); }
  OdometryFaultCounts odometryInputFaults() const override {
    return sequence_->odometryInputFaults();
  }
  std::vector<RangeReading> ranges() const override { return sequence_->ranges(); }
  OdometryNote odometryNote() const override { return sequence_->odometryNote(); }

 protected:
  Sequence& sequence() { return *sequence_; }
  const Sequence& sequence() const { return *sequence_; }

 private:
  std::unique_ptr<Sequence> sequence_;
};

}  // namespace ardrone_vslam
