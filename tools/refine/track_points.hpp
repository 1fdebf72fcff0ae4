// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"

namespace ardrone_vslam {

/// Root of what is known of a ray's direction [1/rad]: of unit noise is root * (true - measured).
using SightRoot = Eigen::Matrix<double, 2, 3>;

constexpr std::size_t kFewestViews = 3;          ///< two rays nearly always meet somewhere
constexpr std::size_t kFewestPresumedViews = 2;  ///< one compares with nothing

/// A keyframe's view of a point.
struct Sight {
  std::size_t keyframe = 0;                                 ///< index into FlightRecord::keyframes
  Eigen::Vector3d bearing_base = Eigen::Vector3d::UnitX();  ///< measured unit ray, axes of base
  SightRoot root_base = SightRoot::Zero();
  double sigma_rad = 0;  ///< of the ray, per axis
};

/// A point of the world, with those who saw it.
struct TrackPoint3d {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();
  std::uint32_t landmark_id = 0;  ///< 0: no landmark
  bool is_joint = false;          ///< of several tracks
  bool is_presumed = false;       ///< the sights do not tell how far away it is
  /// From the first sight, at first; 0: it is not to be compared with those of other points.
  double distance_m = 0;
  std::vector<Sight> sights;  ///< at least fewestViews()

  std::size_t fewestViews() const { return is_presumed ? kFewestPresumedViews : kFewestViews; }
};

/// The points of all tracks with enough parallax, where the keyframes' poses put them. A track is a
/// point of its own, and known as well as its features are. Tracks of one landmark show corners
/// that lie beside each other: the landmark is a point of its own, seen at the ends of these
/// tracks, and known as well as a match is. Keyframes that see few such points, as those of a
/// flight that begins at rest, see the tracks without parallax, too. These are presumed to be as
/// far away as what the nearest other keyframe sees, with which they are to be compared.
/// O(views), and keyframes for each that is presumed.
std::vector<TrackPoint3d> pointsOf(const FlightRecord& record);

}  // namespace ardrone_vslam
