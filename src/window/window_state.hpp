// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "linear/covariance_matrix.hpp"
#include "linear/information.hpp"
#include "window/clone.hpp"

namespace ardrone_vslam {

/// Mean and covariance of the MSCKF: a multi-state constraint Kalman filter (Mourikis
/// and Roumeliotis, ICRA 2007) that keeps some frames as anchors of the map. Error coordinates:
///   0-2   attitude of odom in map [rad]: the odometry's slow attitude error
///   3-5   velocity bias of the odometry, axes of base [m/s]
///   6     scale error: the odometry reports (1 + s) times the way [-]
///   7-9   attitude of the extrinsics [rad], axes of base
///   10    height of the floor in map [m], where heights above it are measured
///   then  the anchors: position of base [m], attitude [rad], and the stretch by the bias of
///         their time, which landmarks share [-]
///   then  the frames, oldest first: position and attitude. They come and go with every image, and
///         at the end they do so without moving the others.
/// A frame's attitude is that of the rig: base, turned by the error of the extrinsics, so that the
/// configured T_base_cam is exactly T_rig_cam. Only the prediction and who asks for the pose need
/// to know of that error. Axes of map; attitude errors are rotation vectors on the left, R_true =
/// exp(error) R. Propagator begins it and adds frames; what follows here are its measurements and
/// its layout.
///
/// One camera sees no scale: all tracks leave the window's dilation open. Two things keep
/// rounds of linearisation from closing it: what errs along the way does so by a multiple of the
/// step (the scale error, and the bias as far as it has the recent velocity's direction), and the
/// covariance's dilation is turned along whenever poses are corrected.
class WindowState {
 public:
  static constexpr int kAttitude = 0;  ///< coordinate of the odometry's attitude error, axes of map
  static constexpr int kBias = 3;      ///< of its velocity bias
  static constexpr int kScale = 6;     ///< of its scale error
  static constexpr int kExtrinsics = 7;  ///< of their error
  static constexpr int kFloor = 10;      ///< of the floor's height
  static constexpr int kGlobals = 11;    ///< number of those above; the anchors follow
  static constexpr int kFrame = 6;       ///< coordinates of a frame
  static constexpr int kAnchor = 7;      ///< and of an anchor

  /// What update() would add to the coordinates of the information; nothing when it is not finite.
  std::optional<Eigen::VectorXd> preview(const Information& information) const;
  /// Corrects globals, anchors and frames. O(coordinates^2 x rank of the information).
  /// @return false when the covariance is not positive or the result not finite; nothing is changed
  bool update(const Information& information);

  /// The floor is where a height above it, measured at the newest frame, says; what was known of
  /// another floor is forgotten.
  void beginFloor(double height_m, double variance_m2);

  /// The next frame is another camera's: nothing is known of the error of its extrinsics, per axis.
  void beginExtrinsics(double variance_rad2);

  /// The camera stands where it stood at a frame: the newest position is taken from there instead
  /// of from the odometry's increments, which leave no trace.
  /// @param camera_rig  the camera's position in the rig
  /// @param sigma_m2  covariance of the camera's way between the two
  void holdNewest(std::size_t reference, const Eigen::Vector3d& camera_rig,
                  const Eigen::Matrix3d& sigma_m2);

  /// Oldest first; the newest one is the present pose.
  const std::vector<Clone>& frames() const { return frames_; }
  /// The present pose.
  const Clone& newest() const { return frames_.back(); }
  /// newest() without the error of the extrinsics.
  Eigen::Isometry3d T_map_base() const;
  /// Of T_map_base(): position [m^2], rotation vector [rad^2], axes of map.
  Matrix6d baseCovariance() const;
  /// Frames that have left the window, as landmarks belong to them.
  const std::vector<Clone>& anchors() const { return anchors_; }
  /// First coordinate of a frame; of frames().size(): one beyond the last frame.
  int frameCoordinate(std::size_t frame) const {
    return anchorCoordinate(anchors_.size()) + kFrame * static_cast<int>(frame);
  }
  /// First coordinate of an anchor; of anchors().size(): that of the first frame.
  int anchorCoordinate(std::size_t anchor) const {
    return kGlobals + kAnchor * static_cast<int>(anchor);
  }
  /// A frame leaves the window and is forgotten. @param frame  index into frames()
  void removeFrame(std::size_t frame);
  /// A frame leaves the window, its error is remembered.
  void makeAnchor(std::size_t frame);
  /// No landmark belongs to it any more. @param anchor  index into anchors()
  void removeAnchor(std::size_t anchor);

  /// The odometry reports (1 + this) times the way.
  double scaleError() const { return scale_error_; }
  /// z of the floor in map; 0 until beginFloor().
  double floor_map_m() const { return floor_map_m_; }
  /// The odometry's, axes of base.
  const Eigen::Vector3d& velocityBias_m_s() const { return velocity_bias_m_s_; }
  /// Turns directions of the odometry's frame to those of map.
  const Eigen::Matrix3d& R_map_odom() const { return R_map_odom_; }
  /// The error of the extrinsics: takes directions of the rig to base.
  const Eigen::Matrix3d& R_base_rig() const { return R_base_rig_; }
  /// Of all coordinates.
  CovarianceMatrix::ConstView covariance() const { return covariance_.all(); }
  /// Of the difference of two poses, which start at these coordinates.
  Matrix6d relativeCovariance(int a, int b) const {
    const auto P = covariance();
    return P.block<6, 6>(a, a) + P.block<6, 6>(b, b) - P.block<6, 6>(a, b) - P.block<6, 6>(b, a);
  }

 private:
  friend class Propagator;   // writes mean and covariance by the odometry
  friend class MapEntrance;  // moves them within a map, or into one

  void inject(const Eigen::VectorXd& error);
  /// What an error of bias and scale, the columns, adds to the coordinates after a correction.
  using Stretch = Eigen::Matrix<double, Eigen::Dynamic, 4>;
  Stretch stretchBy(const Eigen::VectorXd& error) const;

  Eigen::Matrix3d R_map_odom_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_base_rig_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_bias_m_s_ = Eigen::Vector3d::Zero();
  double scale_error_ = 0;
  double floor_map_m_ = 0;
  std::vector<Clone> frames_;
  std::vector<Clone> anchors_;
  CovarianceMatrix covariance_;
};

}  // namespace ardrone_vslam
