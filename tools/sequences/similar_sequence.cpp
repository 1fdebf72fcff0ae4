// SPDX-License-Identifier: BSD-3-Clause
#include "sequences/similar_sequence.hpp"

#include <cmath>
#include <utility>

#include "sequences/sequence_view.hpp"

namespace ardrone_vslam {
namespace {

Eigen::Matrix3d flipped(Eigen::Index axis) {
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs(axis) = -1;
  return signs.asDiagonal();
}

class SimilarSequence : public SequenceView {
 public:
  SimilarSequence(std::unique_ptr<Sequence> sequence, const Similarity& similarity)
      : SequenceView(std::move(sequence)), similarity_(similarity), first_(cameraAt(cameraOf(0))) {
    const Eigen::Matrix3d left_right = flipped(1);  // map's y
    for (StampedPose pose : this->sequence().truth().poses()) {
      pose.stamp_ns = scaled(pose.stamp_ns);
      pose.T_frame_body.translation() *= similarity_.scale;
      if (similarity_.is_mirrored) pose.T_frame_body = mirrored(pose.T_frame_body, left_right);
      truth_.append(pose);
    }
  }

  std::int64_t stamp_ns(std::size_t index) const override {
    return scaled(sequence().stamp_ns(index));
  }
  cv::Mat image(std::size_t index) override {
    const cv::Mat image = sequence().image(index);
    return similarity_.is_mirrored ? mirroredImage(image) : image;
  }
  const CameraIntrinsics& camera() const override { return first_.intrinsics; }
  Eigen::Isometry3d T_base_cam() const override { return first_.T_base_cam; }
  SequenceCamera cameraAt(std::size_t which) const override {
    SequenceCamera camera = sequence().cameraAt(which);
    camera.T_base_cam.translation() *= similarity_.scale;
    if (!similarity_.is_mirrored) return camera;
    camera.T_base_cam = mirrored(camera.T_base_cam, flipped(0));  // the camera's x
    camera.intrinsics.cx_px = camera.intrinsics.width_px - 1 - camera.intrinsics.cx_px;
    camera.intrinsics.p2 = -camera.intrinsics.p2;
    return camera;
  }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<OdometryState>& odometry() const override { return odometry_; }
  std::vector<RangeReading> ranges() const override { return {}; }
  OdometryNote odometryNote() const override { return {}; }
  OdometryFaultCounts odometryInputFaults() const override { return {}; }

 private:
  /// From the first image on, so that stamps stay within an epoch's range.
  std::int64_t scaled(std::int64_t stamp_ns) const {
    const std::int64_t first_ns = sequence().stamp_ns(0);
    return first_ns + std::llround(static_cast<double>(stamp_ns - first_ns) * similarity_.scale);
  }
  /// The pose of what is mirrored left to right, in a world that is.
  static Eigen::Isometry3d mirrored(Eigen::Isometry3d T, const Eigen::Matrix3d& flip_right) {
    const Eigen::Matrix3d flip_left = flipped(1);
    T.linear() = flip_left * T.linear() * flip_right;
    T.translation() = flip_left * T.translation();
    return T;
  }

  Similarity similarity_;
  SequenceCamera first_;
  Trajectory truth_;
  std::vector<OdometryState> odometry_;  // none
};

}  // namespace

std::unique_ptr<Sequence> withSimilarity(std::unique_ptr<Sequence> sequence,
                                         const Similarity& similarity) {
  return std::make_unique<SimilarSequence>(std::move(sequence), similarity);
}

}  // namespace ardrone_vslam
