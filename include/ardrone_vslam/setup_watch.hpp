// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// What of the set-up is wrong, so that images and odometry contradict each other.
enum class SetupFault {
  kNone,
  kExtrinsics,        ///< the camera is turned otherwise than told
  kMirrored,          ///< the images are
  kTimeOffset,        ///< the images' stamps are late or early
  kFocalLength,       ///< the calibration's
  kOdometryPosition,  ///< integrated with a mirrored yaw
  kOdometryYaw,       ///< mirrored
  kStillImages,       ///< the same image again and again
  kUnknown            ///< none of these explains it
};
template <>
struct EnumNames<SetupFault> {
  static constexpr std::array<const char*, 9> kNames{
      "none",         "mounting",     "mirrored",
      "time_offset",  "focal_length", "odometry_position",
      "odometry_yaw", "still_images", "unknown"};
};

/// How the camera turned otherwise than the odometry says, about base's z, between two images.
struct SeenYaw {
  std::int64_t stamp_ns = 0;  ///< of the later image
  double span_s = 0;          ///< between the two; 0: none is known
  double displacement_m = 0;  ///< likewise, by the odometry
  double off_rad = 0;         ///< camera less odometry
  double variance_rad2 = 0;   ///< of this, by images and calibration; the odometry's is not in it
};

/// What the motion so far says of the set-up.
struct SetupFinding {
  SetupFault fault = SetupFault::kNone;  ///< what is wrong, as far as seen
  /// Another fault, or kExtrinsics another mounting, that explains the images nearly as well.
  SetupFault rival = SetupFault::kNone;
  /// Without a fault: the motion since the last fault has shown that there is none.
  bool is_confirmed = false;
  /// The images so far were taken for other times than they were of: what they said is given up.
  bool forgets_images = false;
  /// Whether images may correct the pose.
  bool isCameraUsed() const { return fault == SetupFault::kNone && !forgets_images; }
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();  ///< kExtrinsics: that which fits
  double offset_s = 0;      ///< kTimeOffset: an image is exposed at its stamp plus this, roughly
  double focal_factor = 1;  ///< kFocalLength: the calibration's over the true one, roughly
  SeenYaw yaw;              ///< of the newest pair of images
};

/// What is wrong and what helps, for users; empty without a fault.
/// @param base, camera  names of the frames, for the line that corrects the mounting
std::string explain(const SetupFinding& finding, const std::string& base,
                    const std::string& camera);

/// The command that publishes a camera's mounting.
std::string staticTransformLine(const Eigen::Isometry3d& T_base_cam, const std::string& base,
                                const std::string& camera);

/// Finds faults of the set-up while the camera moves. From two images about a quarter of a second
/// apart come the camera's turn and the direction of its way (fitMotion), without any length. The
/// odometry says both, too. For each fault of a fixed list, and for none, their squared deviations
/// are summed up and forgotten after some sixty of such pairs. A fault is found when it explains
/// the images far better than the set-up as it is told; it ends when that is the other way round.
/// Directions count where the odometry is fast, as its velocity may be wrong by decimetres a
/// second; clocks that are 0.16 s apart or less are no fault here (TimeOffsetEstimator). Memory as
/// for 16 images; none is allocated once the images have been as rich as they get. Deterministic:
/// stamps are its only clock.
class SetupWatch {
 public:
  /// @param T_base_cam  extrinsics, as told: optical frame to base
  /// @param image_time_offset_s  that in use
  explicit SetupWatch(const Eigen::Isometry3d& T_base_cam, double image_time_offset_s = 0);
  ~SetupWatch();
  SetupWatch(SetupWatch&& other) noexcept;             ///< takes what the images said along
  SetupWatch& operator=(SetupWatch&& other) noexcept;  ///< likewise

  /// One image. Stamps that go back: the images before are forgotten.
  /// @param odometry  must keep at least a second, and reach to the image; more is waited for
  void see(const ImageFeatures& features, const OdometryBuffer& odometry);
  /// After the images so far.
  const SetupFinding& finding() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
