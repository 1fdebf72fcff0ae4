// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/msckf_config.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "linear/covariance_matrix.hpp"
#include "odometry/odometry_step.hpp"

namespace ardrone_vslam {

/// A pose of base that the filter estimates: a frame of the window, or an anchor of landmarks.
struct Clone {
  std::uint32_t id = 0;       ///< ascending, never used again in one run
  std::int64_t stamp_ns = 0;  ///< of the image
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();   ///< of base
  Eigen::Matrix3d R_map_rig = Eigen::Matrix3d::Identity();  ///< of the rig, which is base but for
                                                            ///< the extrinsics' error (WindowState)
  /// By what share an error of the odometry's velocity, axes of base, stretches the way here: the
  /// velocity over its square. What is seen from here shares it.
  Eigen::Vector3d stretch_by_bias_s_m = Eigen::Vector3d::Zero();
  std::optional<double> height_m;  ///< above the floor, measured
  double stretch = 1;              ///< by corrections of scale and bias, of what belongs to it
};

/// Place of the pose of this id among them; nothing when there is none. O(poses).
std::optional<std::size_t> indexOf(const std::vector<Clone>& poses, std::uint32_t id);

/// Measurements r = H x + n of some error coordinates, compressed to H' W H and H' W r.
struct Information {
  std::vector<int> coordinates;  ///< of WindowState
  Eigen::MatrixXd matrix;        ///< H' W H, as many rows as coordinates
  Eigen::VectorXd vector;        ///< H' W r

  /// Nothing measured yet of these coordinates: zeros.
  explicit Information(std::vector<int> of_coordinates);
};

/// Mean and covariance of the MSCKF: a multi-state constraint Kalman filter (Mourikis
/// and Roumeliotis, ICRA 2007) that keeps some frames as anchors of the map. Error coordinates:
///   0-2   attitude of odom in map [rad]: the odometry's slow attitude error
///   3-5   velocity bias of the odometry, axes of base [m/s]
///   6     scale error: the odometry reports (1 + s) times the way [-]
///   7-9   attitude of the camera's mounting [rad], axes of base
///   10    height of the floor in map [m], where heights above it are measured
///   then  the anchors: position of base [m], attitude [rad], and the stretch by the bias of
///         their time, which landmarks share [-]
///   then  the frames, oldest first: position and attitude. They come and go with every image, and
///         at the end they do so without moving the others.
/// A frame's attitude is that of the rig: base, turned by the error of the extrinsics, so that the
/// configured T_base_cam is exactly T_rig_cam. Only the prediction and who asks for the pose need
/// to know of that error. Axes of map; attitude errors are rotation vectors on the left, R_true =
/// exp(error) R.
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
  static constexpr int kExtrinsics = 7;  ///< of the mounting's error
  static constexpr int kFloor = 10;      ///< of the floor's height
  static constexpr int kGlobals = 11;    ///< number of those above; the anchors follow
  static constexpr int kFrame = 6;       ///< coordinates of a frame
  static constexpr int kAnchor = 7;      ///< and of an anchor

  /// @param attitude_states  false: the linear form. Attitudes and mounting are taken as exact:
  /// their coordinates stay, without variance, and updates leave out what is measured of them.
  explicit WindowState(const OdometryNoiseConfig& config, bool attitude_states = true);

  /// Map equals odom; the first frame is the window's only one.
  void start(const OdometryState& odometry);
  /// Adds a frame by the odometry's increment since the newest one.
  /// @param step  of that increment: counts as the newest position's uncertainty, not as a way
  void propagate(const OdometryState& odometry,
                 const std::optional<OdometryStep>& step = std::nullopt);
  /// Begins anew beside the anchors, with one frame where the odometry and this transform put it:
  /// what was learned of the odometry's velocity and attitude is forgotten. What the frame moves by
  /// counts as its deviation. There must be no other frame.
  void returnTo(const Eigen::Isometry3d& T_map_odom);
  /// What update() would add to the coordinates of the information; nothing when it is not finite.
  std::optional<Eigen::VectorXd> preview(const Information& information) const;
  /// Corrects globals, anchors and frames. O(coordinates^2 x rank of the information).
  /// @return false when the covariance is not positive or the result not finite; nothing is changed
  bool update(const Information& information);

  /// The floor is where a height above it, measured at the newest frame, says; what was known of
  /// another floor is forgotten.
  void beginFloor(double height_m, double variance_m2);

  /// The camera stands where it stood at a frame: the newest position is taken from there instead
  /// of from the odometry's increments, which leave no trace.
  /// @param camera_base  the camera's position in base
  /// @param sigma_m2  covariance of the camera's way between the two
  void holdNewest(std::size_t reference, const Eigen::Vector3d& camera_base,
                  const Eigen::Matrix3d& sigma_m2);

  /// Oldest first; the newest one is the present pose.
  const std::vector<Clone>& frames() const { return frames_; }
  /// The present pose.
  const Clone& newest() const { return frames_.back(); }
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
  /// Takes the odometry's velocity for so many times worse, in variance, as it is configured.
  void inflate(double factor);
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
  /// Of the odometry, axes of base, over what is configured.
  double biasSigmas() const;
  /// Takes the odometry's newest pose to the newest frame's.
  Eigen::Isometry3d T_map_odom() const;
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
  /// Growth of the position's variance, per axis, by white noise of the odometry.
  double walkVariance_m2(const OdometryState& odometry, double dt_s, double displacement_m) const;
  void propagateGlobals(const OdometryState& odometry, double dt_s, double displacement_m);
  void inject(const Eigen::VectorXd& error);
  /// What an error of bias and scale, the columns, adds to the coordinates after a correction.
  using Stretch = Eigen::Matrix<double, Eigen::Dynamic, 4>;
  Stretch stretchBy(const Eigen::VectorXd& error) const;
  Eigen::Vector3d recentVelocity_base_m_s() const;

  OdometryNoiseConfig config_;
  double inflation_ = 1;
  OdometryState odometry_;
  std::uint32_t next_id_ = 1;
  Eigen::Matrix3d R_map_odom_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_base_rig_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_bias_m_s_ = Eigen::Vector3d::Zero();
  double odometry_way_m_ = 0;  // since it began
  double scale_error_ = 0;
  double floor_map_m_ = 0;
  std::vector<Clone> frames_;
  std::vector<Clone> anchors_;
  CovarianceMatrix covariance_;
};

}  // namespace ardrone_vslam
