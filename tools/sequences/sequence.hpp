// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/height_input.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_faults.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

/// Share of a recording whose loss makes the results those of another flight.
constexpr double kMuchLost = 0.05;

/// How a simulated odometry was made.
struct OdometryNote {
  std::string profile;
  std::optional<std::uint64_t> seed;
  double scale_error = 0;  ///< the one that was drawn
};

/// One of a sequence's cameras.
struct SequenceCamera {
  CameraIntrinsics intrinsics;
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
};

/// A recorded or rendered sequence of images: what replay runs on and what make_bag and make_world
/// write. Images are asked for in ascending order, each once; `image` may be slow (decoding,
/// rendering).
class Sequence {
 public:
  virtual ~Sequence() = default;

  virtual std::string name() const = 0;  ///< for messages: the folder, file or flight
  virtual std::size_t size() const = 0;
  virtual std::int64_t stamp_ns(std::size_t index) const = 0;
  /// 8-bit grey, of the size of its camera. @throws std::runtime_error naming the file and the
  /// fault
  virtual cv::Mat image(std::size_t index) = 0;
  /// Of the first image.
  virtual const CameraIntrinsics& camera() const = 0;
  virtual Eigen::Isometry3d T_base_cam() const = 0;
  /// Which camera took an image, where they take turns.
  virtual std::size_t cameraOf(std::size_t /*index*/) const { return 0; }
  virtual SequenceCamera cameraAt(std::size_t /*which*/) const { return {camera(), T_base_cam()}; }
  /// True poses of base, world = map of the first frame's convention; empty when unknown.
  virtual const Trajectory& truth() const = 0;
  /// The recorded odometry; empty when there is none.
  virtual const std::vector<OdometryState>& odometry() const = 0;
  /// What was found of it already, beside what an OdometryAdapter will find.
  virtual OdometryFaultCounts odometryInputFaults() const { return {}; }
  /// What a range sensor under base read; empty when there is none.
  virtual std::vector<RangeReading> ranges() const { return {}; }
  /// How the recorded odometry came about; empty when it is a real one or unknown.
  virtual OdometryNote odometryNote() const { return {}; }
};

/// T_base_cam of a forward camera with optical axes (x right, y down, z forward) at the base:
/// REP-103.
Eigen::Isometry3d forwardCamera();

/// Which frames of a sequence, and in what order: --frames A:B:STEP and --ping-pong.
struct FrameSelection {
  std::size_t begin = 0;
  std::optional<std::size_t> end;  ///< one past the last frame; nothing: all
  std::size_t step = 1;
  bool ping_pong = false;  ///< the selected frames 0, 2, 4 .. forward, then the odd ones backward;
                           ///< stamps ascend at the nominal rate (the median interval of the
                           ///< selected frames), truth follows the images

  /// "A:B:STEP", each part optional. @throws std::invalid_argument that says what is wrong
  static FrameSelection parse(const std::string& text, bool ping_pong);
};

/// View of a sequence through a selection. With ping-pong truth is re-stamped; a recorded
/// odometry and ranges are dropped.
std::unique_ptr<Sequence> select(std::unique_ptr<Sequence> sequence,
                                 const FrameSelection& selection);

/// KITTI folder (image_0/, calib.txt, times.txt, poses.txt) or TUM-like folder (image/,
/// camera.yaml, times.txt, poses_tum.txt, odometry_tum.txt, range.txt). @throws std::runtime_error
/// naming the missing or wrong file and the remedy
std::unique_ptr<Sequence> openFolder(const std::string& path);

}  // namespace ardrone_vslam
