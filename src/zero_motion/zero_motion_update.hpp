// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "ardrone_vslam/features.hpp"
#include "window/window_state.hpp"
#include "zero_motion/scene_depth.hpp"
#include "zero_motion/zero_motion_detector.hpp"

namespace ardrone_vslam {

/// Whether odometry may err by so much meanwhile. Otherwise the image stands still beside it for
/// another reason (a frozen stream).
bool mayBeDrift(double error_m, double passed_s);

/// How well the rotation from a frame of the window to the newest one is known, per axis.
double rotationSigma_rad(const WindowState& state, std::size_t frame);

/// Holds the newest pose where the image is still (a zero-motion update). The frame that it
/// compares the image with, its reference, stays in the window even when it is no keyframe.
class ZeroMotionUpdate {
 public:
  /// Looks at the newest frame, and holds its position when the camera rests or turns on the spot.
  /// @param T_odom_base  by the odometry alone, jumps left out
  /// @param is_located  landmarks say where the camera is, so that nothing is held
  void apply(const ImageFeatures& features, const Eigen::Isometry3d& T_rig_cam,
             const Eigen::Isometry3d& T_odom_base, bool is_located, WindowState& state);
  /// The newest frame's image is not looked at.
  void skip() { motion_ = CameraMotion::kUnknown; }
  /// The image says this of the newest frame; moving where the odometry contradicts it.
  CameraMotion motion() const { return motion_; }
  /// How far away the scene is, as learned from the images given to apply().
  const SceneDepth& sceneDepth() const { return scene_depth_; }

  /// A frame of this id has become a keyframe.
  void noteKeyframe(std::uint32_t id) { reference_is_keyframe_ |= reference_id_ == id; }
  /// Whether the frame of this id is the reference.
  bool isReference(std::uint32_t id) const { return reference_id_ == id; }
  /// Whether the frame of this id is in the window only as the reference.
  bool isReferenceOnly(std::uint32_t id) const {
    return isReference(id) && !reference_is_keyframe_;
  }
  /// Whether the window has one frame more than keyframes call for.
  bool keepsExtraFrame(const WindowState& state) const {
    return !reference_is_keyframe_ && indexOf(state.frames(), reference_id_);
  }
  /// Begins anew; a frame that was only the reference leaves.
  void beginAnew(WindowState& state);
  /// Begins anew; whoever calls it has removed the frames.
  void reset();

 private:
  bool holdStill(std::size_t reference, const Eigen::Isometry3d& T_rig_cam, WindowState& state);
  void dropReference(WindowState& state) const;

  ZeroMotionDetector detector_;
  SceneDepth scene_depth_;
  CameraMotion motion_ = CameraMotion::kUnknown;
  std::uint32_t reference_id_ = 0;  // 0: none
  bool reference_is_keyframe_ = false;
  Eigen::Vector3d odometry_displacement_ = Eigen::Vector3d::Zero();  // while the camera is held
};

}  // namespace ardrone_vslam
