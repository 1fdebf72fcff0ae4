// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/flight_record.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "ardrone_vslam/setup_monitor.hpp"
#include "ardrone_vslam/slam.hpp"
#include "config_files/config_file.hpp"
#include "input_checks/standstill_watch.hpp"
#include "run/front_end.hpp"
#include "run/recorded_inputs.hpp"
#include "sequences/sequence.hpp"
#include "simulation/odometry_model.hpp"
#include "stamps/stage_timer.hpp"

namespace ardrone_vslam {

/// One image's answer.
struct RunFrame {
  FrameResult result;
  StageTimes_ms times_ms{};
  std::int64_t image_time_offset_ns = 0;  ///< in use at this image

  std::int64_t exposed_ns() const { return result.stamp_ns + image_time_offset_ns; }
};

/// What a refinement afterwards made of a run.
struct RefinedRun {
  std::vector<Eigen::Isometry3d> T_map_base;  ///< of each frame
  std::size_t keyframes = 0;
  std::size_t points = 0;
  std::size_t views = 0;           ///< of points by keyframes, those that count
  std::size_t views_left_out = 0;  ///< as they contradict the others
  /// Of the last camera: a rotation vector, axes of base. 0 where they were taken as exact.
  Eigen::Vector3d extrinsics_error_rad{0, 0, 0};
  std::optional<Eigen::Vector3d>
      extrinsics_sigma_rad;  ///< where it was asked how well all is known
  double seconds = 0;        ///< that it took
};

/// One pass over a sequence with one odometry.
struct RunResult {
  bool is_finished = false;  ///< false: what there is so far
  std::vector<RunFrame> frames;
  Landmarks landmarks;
  bool is_in_loaded_map = false;  ///< frames before it was found there are kSearchingMap
  std::optional<SavedMap> map;    ///< when it was asked for, and is not that of another origin
  FlightRecord record;            ///< when it was asked for
  std::optional<RefinedRun> refined;
  int frames_without_odometry =
      0;  ///< no odometry at the image's stamp: before the first state, in a gap, or after the last
  int frames_dropped_slow = 0;      ///< that the emulated slower computer had no time for
  int odometry_states_refused = 0;  ///< not finite, out of bounds, duplicate or backward stamps
  OdometryFaultCounts odometry_faults{};
  std::uint64_t ranges_refused = 0;
  std::uint64_t heights_missing = 0;  ///< images without a range near their stamp
  std::uint64_t heights_tilted = 0;   ///< images without a height as base was tilted
  /// The tracks moved for seconds on end by more than the odometry's turning explains.
  bool images_travel = false;
  bool odometry_froze = false;  ///< for a while, although the images travelled
  double absurd_speed_m_s = 0;  ///< of the odometry, when it is too fast to be in metres
  int camera_changes = 0;
  NumberOrAuto image_time_offset_told_s;  ///< the parameter
  double image_time_offset_s = 0;         ///< in use at last
  std::int64_t time_offset_found_ns = 0;  ///< stamp of the image since which; 0: as told
  TimeOffset time_offset;                 ///< what it seems to be
  SetupFinding setup;  ///< the last fault that was found, or else what is known at last
  std::int64_t setup_fault_ns =
      0;                   ///< stamp of the image at which a fault was first found; 0: none
  double scale_error = 0;  ///< the one drawn for the odometry
};

/// Images at which the camera was left out, by a fault of the set-up or by the watchdog.
std::int64_t countDistrusted(const RunResult& run);

/// The maps of a run.
struct RunMaps {
  std::optional<SavedMap> loaded;  ///< in which the flight takes place
  bool is_saved = false;           ///< into RunResult::map
  bool is_recorded = false;        ///< RunResult::record is made
};

/// Images before the flight was found in a loaded map.
std::int64_t countSearching(const RunResult& run);

/// What there is of each run.
using ResultsSoFar = std::function<std::vector<RunResult>()>;
/// Called with the number of images done, from the calling thread.
using Progress = std::function<void(std::size_t done, const ResultsSoFar& so_far)>;

/// Features + odometry -> poses and map, as the nodelets do it: odometry through an
/// OdometryAdapter, interpolated at the image's stamp by an OdometryBuffer, ranges by a
/// HeightInput.
class BackEnd {
 public:
  BackEnd(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
          const std::vector<OdometryState>& odometry, std::vector<RangeReading> ranges = {});
  /// Before the first frame. @throws std::invalid_argument as Slam::load
  void load(const SavedMap& map);
  /// RunResult::record is wanted. Before the first frame
  void record() { recorder_.emplace(config_, T_base_cam_); }
  /// @return what the image has cost, front end included [ms]
  double process(const TrackedFrame& frame);
  /// @param is_finished  no frame will follow: the record goes along
  /// @param is_map_saved  the map goes along. @throws std::invalid_argument as Slam::save
  RunResult result(bool is_finished = false, bool is_map_saved = false) const;

 private:
  void changeCamera(const Eigen::Isometry3d& T_base_cam);
  void watchSetup(const ImageFeatures& features);

  SlamConfig config_;
  Slam slam_;
  Eigen::Isometry3d T_base_cam_;
  std::optional<FlightRecorder> recorder_;
  SetupMonitor setup_;
  StandstillWatch watch_;       ///< sees odometry that only turns: what moves then is the images
  StandstillWatch standstill_;  ///< the same with its positions
  RecordedOdometry odometry_;
  RecordedHeights heights_;
  RunResult run_;
};

}  // namespace ardrone_vslam
