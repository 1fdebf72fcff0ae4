// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "ardrone_vslam/slam.hpp"

namespace ardrone_vslam {

/// The map files of a flight (docs/map_files.md): it is looked for in the map of one, and its own
/// map is written to the other, in flight and at the end.
class FlightMap {
 public:
  struct Files {
    std::string loaded;     ///< empty: the flight begins a map
    std::string saved;      ///< empty: its map is not kept
    double autosave_s = 0;  ///< in flight; 0: only at the end
    bool is_fixed = false;  ///< with localise_only there is nothing new to save
  };

  /// @throws MapFileError when no map can be written there
  explicit FlightMap(Files files);
  ~FlightMap();
  FlightMap(const FlightMap&) = delete;
  FlightMap& operator=(const FlightMap&) = delete;

  /// The map to look for the flight in, if there is one.
  /// @param most_landmarks  that there is memory for
  /// @throws MapFileError also for another camera's map and for too large a one
  std::optional<SavedMap> read(const MapCamera& camera, std::size_t most_landmarks);
  /// A map begins. What it can be refined with later is kept, where the map is saved.
  void begin(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam);
  /// A frame that the flight's Slam has answered, and its landmarks then.
  void see(const ImageFeatures& features, const OdometryState& odometry, const FrameResult& result,
           const Landmarks& landmarks);
  /// The flight's map begins anew, empty: what was loaded is not loaded again, and stays in the
  /// file, as does what was saved in flight.
  void giveUp();
  /// The flight's map begins anew, in the loaded one. As giveUp() where there is none.
  void beginAnew();

  /// Writes the flight's map if its time has come. A child of the process, which has all memory as
  /// it is now, makes the file; the flight waits for the fork alone. Says on stderr what goes
  /// wrong.
  /// @param now_ns  of any clock, that of all calls
  void saveInFlight(const Slam& slam, std::int64_t now_ns);
  /// @return what became of the map, a sentence; empty without a file
  /// @throws MapFileError when the flight has a map that is not saved
  std::string saveAtEnd(const Slam& slam);

 private:
  bool isToBeSaved() const;
  void waitForChild(int options);

  Files files_;
  std::optional<FlightRecorder> recorder_;
  std::int64_t next_save_ns_ = 0;  // 0: the first is after one period
  pid_t child_ = 0;                // that writes; 0: none
  bool is_saved_ = false;          // in flight
  bool is_given_up_ = false;
};

}  // namespace ardrone_vslam
