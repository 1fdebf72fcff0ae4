// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "ardrone_vslam/flight_record.hpp"
#include "ardrone_vslam/slam.hpp"
#include "conversions/conversions.hpp"
#include "inputs/camera_identity.hpp"
#include "mapper/setup_report.hpp"
#include "stamps/stage_timer.hpp"

namespace ardrone_vslam {

/// The Slam of the camera that the features come from, and what is counted of it. There is none
/// before the first camera, and none from the end of a map to the next image.
class LiveSlam {
 public:
  LiveSlam(const SlamConfig& config, Warnings& warnings)
      : config_(config), setup_(config.image_time_offset_s, warnings) {}

  bool hasMap() const { return in_use_.has_value(); }
  /// As useCamera() was told last.
  const CameraIdentity& camera() const { return camera_; }
  const Eigen::Isometry3d& T_base_cam() const { return T_base_cam_; }
  /// Makes the Slam, or has it change the camera.
  /// @param base, frame  names of the drone's and the camera's frames in tf
  void useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam,
                 const std::string& base, const std::string& frame);
  /// What begins from now on begins in this map of an earlier flight; nothing: in an empty one.
  /// @throws MapFileError when the estimator has no use for maps, or the camera in use is another
  /// one
  void useMap(std::shared_ptr<const SavedMap> loaded);
  /// What tells this camera from the loaded map's; empty when nothing does, and without such a map.
  std::string mapFault(const CameraIdentity& camera) const;
  /// With localise_only there is nothing new to save.
  bool isMapFixed() const { return (in_use_ ? in_use_->loaded_map : config_.msckf).localise_only; }
  /// The map for a file. @throws MapFileError when there is none, or none of the loaded map's frame
  MapSnapshot save() const;
  /// @throws std::exception when there is no map to look in
  void lookNear(const PlaceHint& hint);
  /// Of the map in use and of later ones. @param loaded_map  of later ones alone
  /// @throws std::invalid_argument where the loaded map would be too large
  void change(const LandmarkMapConfig& landmark_map, const FrameBudgetConfig& frame_budget,
              const LoadedMapConfig& loaded_map);
  void countCameraChange() { ++counts_.camera_changes; }
  void endMap();

  /// One image of the camera in use.
  /// @param odometry  at its exposure; `odometries` reach to there
  /// @return valid until the next call, or endMap()
  const FrameResult& process(const Features& message, OdometryState odometry,
                             const OdometryBuffer& odometries);
  /// Of the image processed last.
  const ImageFeatures& features() const { return features_; }
  double milliseconds(Stage stage) const { return times_ms_[static_cast<std::size_t>(stage)]; }
  /// @pre hasMap()
  const Slam& slam() const { return in_use_->slam; }
  /// Stamp of the newest image in the map; 0: none.
  std::int64_t answered_ns() const { return answered_ns_; }
  /// To be called once a second. @return whether an image was answered within it
  bool endSecond();

  struct Counts {
    std::uint64_t images = 0;  ///< answered with a pose
    std::uint64_t heights_rejected = 0;
    std::uint64_t results_not_finite = 0;
    std::uint64_t restarts = 0;  ///< of the map
    std::uint64_t camera_changes = 0;
    std::array<std::uint64_t, kOptionalWorkNames.size()> left_out{};  ///< images without that work
  };
  const Counts& counts() const { return counts_; }
  const SetupReport& setup() const { return setup_; }
  void fill(Status& status) const;

 private:
  /// From the begin of a map to its end.
  struct InUse {
    InUse(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam);

    Slam slam;
    FlightRecorder recorder;
    LoadedMapConfig loaded_map;  ///< as it began
  };

  SlamConfig config_;
  std::shared_ptr<const SavedMap> loaded_;
  std::optional<InUse> in_use_;
  SetupReport setup_;
  CameraIdentity camera_;
  Eigen::Isometry3d T_base_cam_ = Eigen::Isometry3d::Identity();
  ImageFeatures features_;  // kept for its memory
  StageTimes_ms times_ms_{};
  std::int64_t answered_ns_ = 0;
  bool has_answered_ = false;  // within this second
  Counts counts_;
};

}  // namespace ardrone_vslam
