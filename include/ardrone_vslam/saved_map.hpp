// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// A pose of an earlier flight that landmarks belong to: they share its error.
struct MapAnchor {
  Eigen::Isometry3d T_map_rig = Eigen::Isometry3d::Identity();  ///< as Clone has it
  std::int64_t stamp_ns = 0;                                    ///< of its image
};

/// As much of a camera as a map depends on: descriptors look otherwise to another one.
struct MapCamera {
  int width_px = 0;            ///< of the images
  int height_px = 0;           ///< of the images
  double focal_length_px = 0;  ///< geometric mean of fx and fy
};

/// A map as it outlives the flight: what a later one needs to find itself in it and to know how
/// well (docs/map_files.md has its file).
struct SavedMap {
  /// Coordinates of an anchor in the covariance: position [m], attitude (a rotation vector, axes of
  /// map) [rad], and the share by which the landmarks' distances from it err together [-]: too long
  /// where it is positive.
  static constexpr int kAnchor = 7;

  std::string frame_id = "map";       ///< that the positions are in
  std::int64_t stamp_ns = 0;          ///< of the last image that it was made of
  std::vector<MapCamera> cameras;     ///< that saw it, each once; a file has at least one
  std::vector<MapAnchor> anchors;     ///< oldest first
  Eigen::MatrixXd anchor_covariance;  ///< of all anchors, kAnchor coordinates each
  std::vector<Landmark> landmarks;    ///< `anchor_id` is 1 + the index into `anchors`
  FlightRecord flight;                ///< that made it; without keyframes: not kept
  std::string made_by;                ///< of a file: program and version; empty: it does not say
};

/// Leaves these anchors, in this order, and their landmarks; the flight's record stays.
/// @param anchors  indices into `map.anchors`, none twice. @pre each landmark has its anchor
void keepAnchors(SavedMap& map, const std::vector<std::size_t>& anchors);
/// Leaves the anchors that landmarks belong to. @pre each landmark has its anchor
void keepUsedAnchors(SavedMap& map);

/// A flight's map as it was after one frame. It shares the landmarks and keyframes with the flight:
/// to take it costs the flight little, however large its map is, and another thread makes of it
/// what goes into a file.
struct MapSnapshot {
  SavedMap all_but_landmarks;                          ///< and without the anchors' covariance
  std::vector<std::uint32_t> anchor_ids;               ///< Landmark::anchor_id of each
  std::function<Eigen::MatrixXd()> anchor_covariance;  ///< as SavedMap has it
  Landmarks landmarks;                                 ///< those of other anchors are not saved
  /// Of each landmark; nothing: Landmark::anchor_id.
  std::shared_ptr<const std::vector<std::uint32_t>> anchor_of_landmark;

  MapSnapshot() = default;
  /// Of a map as a file has it. O(landmarks).
  explicit MapSnapshot(SavedMap map);
  /// For a file; anchors that no landmark belongs to are left out. O(landmarks + anchors^2). Uses
  /// the snapshot up.
  SavedMap map() &&;
};

/// Where in a map somebody says that base is: a click in a picture of it.
struct PlaceHint {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();  ///< x and y; the height is not told
  double heading_rad = 0;                                    ///< of base, about z of map
  double position_sigma_m = 0.5;                             ///< per axis
  double heading_sigma_rad = 0.26;                           ///< 15 degrees, as rviz has it
};

/// A map file that cannot be read, and why; a file that cannot be written.
class MapFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes the map into a file beside `path` first, and onto the disk, so that there is always the
/// old map or the new one. The same bytes on every processor. Landmarks with an anchor that is not
/// there, or with numbers that cannot be (not finite, a negative variance, a view direction of
/// another length than 1), are left out, and so is a flight that could not be read again.
/// @param made_by  program and version, at most 255 bytes; empty: the file does not say
/// @throws MapFileError naming the file and what is wrong
/// @return landmarks written
std::size_t writeMap(const std::string& path, const SavedMap& map, const std::string& made_by = {});

/// @throws MapFileError when writeMap() could not write there, as far as can be told before
void checkWritable(const std::string& path);

/// Whether a map is read with the record of the flight that made it, which a drone has no use for.
enum class WithFlight { kNo, kYes };

/// Reads a map file of this or an earlier version and checks all of it before it answers.
/// @throws MapFileError naming the file, what is wrong and what to do
SavedMap readMap(const std::string& path, WithFlight with_flight = WithFlight::kNo);

/// What tells a camera from those of a map; empty when it is one of them, be it with another
/// calibration.
std::string cameraDifference(const std::vector<MapCamera>& of_map, const MapCamera& other);
/// Unless it is there.
void addCamera(const MapCamera& camera, std::vector<MapCamera>& cameras);

}  // namespace ardrone_vslam
