// SPDX-License-Identifier: BSD-3-Clause
// What a refinement weighs against each other, as functors that Ceres derives by itself. Each
// residual is of unit noise. A keyframe's error is a position [m] and a rotation vector on the left
// [rad], axes of map, beside where it was at first. The odometry's attitude error is a tilt about
// base's x and y and a yaw about what is up [rad].
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/rotation.h>

#include <Eigen/Core>
#include <cmath>

namespace ardrone_vslam {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

/// rotationOf(rotation_vector) v.
template <class T>
Vector3<T> rotated(const T* rotation_vector, const Vector3<T>& v) {
  Vector3<T> result;
  ceres::AngleAxisRotatePoint(rotation_vector, v.data(), result.data());
  return result;
}

/// The rotation vector of exp(a) R exp(b)^T, of small angles but for R's.
template <class T>
Vector3<T> rotationBetween(const T* a, const Eigen::Matrix<T, 3, 3>& R, const T* b) {
  Eigen::Matrix<T, 3, 3> A, B;
  ceres::AngleAxisToRotationMatrix(a, A.data());
  ceres::AngleAxisToRotationMatrix(b, B.data());
  const Eigen::Matrix<T, 3, 3> difference = A * R * B.transpose();
  Vector3<T> vector;
  ceres::RotationMatrixToAngleAxis(difference.data(), vector.data());
  return vector;
}

/// What a functor answers.
template <class T, int kCount>
bool put(const Eigen::Matrix<T, kCount, 1>& value, T* residual) {
  Eigen::Map<Eigen::Matrix<T, kCount, 1>> out(residual);
  out = value;
  return true;
}

/// A keyframe saw a point along a ray.
struct ViewResidual {
  Eigen::Matrix<double, 2, 3> root_base;  ///< of what is known of the ray's direction [1/rad]
  Eigen::Vector3d bearing_base;
  Eigen::Vector3d camera_base;
  Eigen::Isometry3d T_map_base;  ///< at first

  template <class T>
  bool operator()(const T* pose, const T* point, T* residual) const {
    const Eigen::Map<const Vector3<T>> error(pose), point_map(point);
    const T back[3] = {-pose[3], -pose[4], -pose[5]};
    const Vector3<T> offset_map = point_map - error - T_map_base.translation().cast<T>();
    const Vector3<T> offset_base =
        T_map_base.linear().transpose().cast<T>() * rotated<T>(back, offset_map) -
        camera_base.cast<T>();
    const Vector3<T> off = offset_base.normalized() - bearing_base.cast<T>();
    return put<T, 2>(root_base.cast<T>() * off, residual);
  }
};

/// How far away a point is from a keyframe, beside what all such distances have grown by.
struct DistanceResidual {
  Eigen::Vector3d camera_map;  ///< at first
  double distance_m;           ///< likewise
  double sigma;                ///< of the logarithm

  template <class T>
  bool operator()(const T* pose, const T* point, const T* grown, T* residual) const {
    const Eigen::Map<const Vector3<T>> error(pose), point_map(point);
    const Vector3<T> offset_map = point_map - error - camera_map.cast<T>();
    residual[0] = (log(offset_map.norm() / T(distance_m)) - grown[0]) / T(sigma);
    return true;
  }
};

/// The odometry's way between two keyframes, with its errors: attitude, velocity bias (axes of
/// base), scale. They are put onto the true way: taken off the odometry's, a smaller world would
/// have less noise.
struct WayResidual {
  Eigen::Vector3d from_map, to_map;  ///< at first
  Eigen::Vector3d way_odom_m;
  Eigen::Matrix3d R_odom_base;
  Eigen::Matrix3d attitude_axes_map;
  double duration_s, sigma_m;

  template <class T>
  bool operator()(const T* from, const T* to, const T* attitude, const T* bias, const T* scale,
                  T* residual) const {
    const Eigen::Map<const Vector3<T>> a(from), b(to), bias_base(bias);
    const Eigen::Map<const Vector3<T>> attitude_error(attitude);
    const Vector3<T> back = -(attitude_axes_map.cast<T>() * attitude_error);
    const Vector3<T> way_map = b - a + (to_map - from_map).cast<T>();
    const Vector3<T> reported = rotated<T>(back.data(), way_map) * (T(1) + scale[0]) +
                                R_odom_base.cast<T>() * bias_base * T(duration_s);
    return put<T, 3>((reported - way_odom_m.cast<T>()) / T(sigma_m), residual);
  }
};

/// The odometry's attitude at a keyframe, of base. The pose is that of the rig: base, turned by the
/// error of the camera's extrinsics (a rotation vector, axes of base), where that is not exact.
struct AttitudeResidual {
  Eigen::Matrix3d R_map_rig;  ///< at first
  Eigen::Matrix3d R_odom_base;
  Eigen::Matrix3d attitude_axes_map;
  double sigma_rad;

  template <class T>
  bool operator()(const T* pose, const T* attitude, T* residual) const {
    const T exact[3] = {T(0), T(0), T(0)};
    return (*this)(pose, attitude, exact, residual);
  }
  template <class T>
  bool operator()(const T* pose, const T* attitude, const T* extrinsics, T* residual) const {
    Eigen::Matrix<T, 3, 3> R_base_rig;
    ceres::AngleAxisToRotationMatrix(extrinsics, R_base_rig.data());
    const Eigen::Matrix<T, 3, 3> R =
        R_map_rig.cast<T>() * R_base_rig.transpose() * R_odom_base.transpose().cast<T>();
    const Eigen::Map<const Vector3<T>> attitude_error(attitude);
    const Vector3<T> error_map = attitude_axes_map.cast<T>() * attitude_error;
    return put<T, 3>(rotationBetween<T>(pose + 3, R, error_map.data()) / T(sigma_rad), residual);
  }
};

/// From one keyframe to the next a slow error fades and grows anew; along an axis where `keep` is 1
/// it walks.
struct SlowErrorResidual {
  Eigen::Vector3d keep, sigma;

  template <class T>
  bool operator()(const T* from, const T* to, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (to[i] - T(keep[i]) * from[i]) / T(sigma[i]);
    return true;
  }
};

/// What is known of a few numbers before anything was measured: they are 0.
template <int kCount>
struct PriorResidual {
  Eigen::Matrix<double, kCount, 1> sigma;

  template <class T>
  bool operator()(const T* value, T* residual) const {
    for (int i = 0; i < kCount; ++i) residual[i] = value[i] / T(sigma[i]);
    return true;
  }
};

/// A pose's position is where it was at first.
struct StartResidual {
  double sigma_m;

  template <class T>
  bool operator()(const T* pose, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = pose[i] / T(sigma_m);
    return true;
  }
};

/// A keyframe's height above a floor.
struct HeightResidual {
  double height_m, z_map_m, sigma_m;  ///< z_map_m: at first

  template <class T>
  bool operator()(const T* pose, const T* floor, T* residual) const {
    residual[0] = (pose[2] + T(z_map_m - height_m) - floor[0]) / T(sigma_m);
    return true;
  }
};

/// What a ceres::Problem takes, and then owns.
template <class Residual, int kResiduals, int... kSizes>
ceres::CostFunction* costOf(const Residual& residual) {
  return new ceres::AutoDiffCostFunction<Residual, kResiduals, kSizes...>(new Residual(residual));
}

}  // namespace ardrone_vslam
