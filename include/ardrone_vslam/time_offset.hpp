// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// Whether the images' time offset can be told, and why not; `explain` gives the sentence for
/// users.
enum class TimeOffsetState {
  kTooFewImages,       ///< too few images with enough tracks and odometry around them yet
  kTooLittleRotation,  ///< the camera has not turned to and fro enough to tell within kSure_s
  kDisagreement,       ///< at no offset do camera and odometry turn alike
  kOutOfReach,         ///< the best offset is at the end of those that are compared
  kKnown
};

/// What is known of the images' time offset.
struct TimeOffset {
  TimeOffsetState state = TimeOffsetState::kTooFewImages;  ///< whether it is known
  /// An image is exposed at its stamp plus this, on the odometry's clock; negative where images are
  /// stamped late. 0 unless known.
  double offset_s = 0;
  double sigma_s = 0;  ///< 0 unless known
};

/// Finds the images' time offset: that at which the attitude turns as the tracks do. Images about
/// kStep_s apart are compared with those kSpan_s before (fitRotation, so depths do not matter);
/// for each offset of a grid the squares of the differences between the two turns, in sigmas,
/// are summed up and forgotten with kMemory_s. Constant differences between them are fitted away:
/// of the rates (drift of the attitude) and, by the turn about each axis, of scale (calibration,
/// and the camera's way about base while it turns). The sums' minimum is the offset. Bounded
/// memory, none allocated once the images have been as rich as they get. Deterministic: stamps are
/// its only clock.
class TimeOffsetEstimator {
 public:
  static constexpr std::int64_t kReach_ns = 260'000'000;  ///< offsets compared, about the centre
  static constexpr std::int64_t kGrid_ns = 10'000'000;    ///< from one offset to the next
  static constexpr std::int64_t kStep_ns =
      90'000'000;  ///< from one image used to the next, at least
  static constexpr std::int64_t kSpan_ns =
      270'000'000;                          ///< an image is compared with one so much older
  static constexpr double kMemory_s = 30;   ///< time constant of forgetting
  static constexpr double kSure_s = 0.005;  ///< a sigma above this is not told

  /// @param T_base_cam  extrinsics: optical frame to base
  /// @param centre_s  the offset that is used so far: the grid lies about it
  explicit TimeOffsetEstimator(const Eigen::Isometry3d& T_base_cam, double centre_s = 0);
  ~TimeOffsetEstimator();

  /// One image; it is used once the images are kReach_ns further, so `odometry`
  /// need only reach to the image's stamp plus the centre. O(tracks log tracks) for every image
  /// that is kStep_ns after the last one used, else O(1). Stamps that go back are a new run: images
  /// that wait are forgotten, what was found stays, as the clocks are the same.
  void see(const ImageFeatures& features, const OdometryBuffer& odometry);

  /// By the images seen so far.
  const TimeOffset& estimate() const;

  /// Another camera of the same clock takes over: what was found stays.
  void useCamera(const Eigen::Isometry3d& T_base_cam);

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// A sentence for users; empty for kKnown.
const char* explain(TimeOffsetState state);

/// Whether what is found is another offset than that in use: by more than three sigmas and 15 ms.
bool isOther(const TimeOffset& found, double used_s);

/// A sentence for users on an offset that was found.
/// @param told_s  the parameter image_time_offset_s. For one that is told: empty unless
/// isOther(). For `auto`: empty unless another offset than 0 is used
/// @param used_s  the offset in use
std::string adviceOn(const TimeOffset& found, const NumberOrAuto& told_s, double used_s);

}  // namespace ardrone_vslam
