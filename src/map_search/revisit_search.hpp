// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "estimator/frame_budget.hpp"
#include "map/landmark_map.hpp"
#include "map_search/place_look.hpp"
#include "map_search/place_sights.hpp"
#include "window/map_entry.hpp"

namespace ardrone_vslam {

/// Finds a flight in its own map where it does not think to be: it was carried there with the
/// camera covered, or its odometry erred by more than any search window allows for. While no
/// landmark of an earlier visit is recognised, it looks at the whole map now and then, and more
/// often once it has seen something. A place counts as one in a loaded map does, see PlaceSights.
class RevisitSearch {
 public:
  explicit RevisitSearch(const SlamConfig& config) : look_(config) {}

  /// The image seen last agreed with landmarks that were made then or earlier; nothing: with none.
  /// Not called: landmarks were not looked for in it.
  void know(std::optional<std::int64_t> since_ns) {
    known_since_ns_ = since_ns;
    has_looked_ = true;
  }
  /// The next image is another camera's: that it has no tracks says nothing.
  void changeCamera() { is_another_camera_ = true; }
  /// An image, before its landmarks are looked for. Costs a PlaceLook once a second at most, five
  /// times a second while one sight follows another.
  /// @param is_trusted  the camera, as of the image before
  /// @param T_map_cam  where the camera is thought to be
  /// @param budget  a look waits until it has the time
  /// @return where it is instead, until that is noted
  std::optional<Revisit> see(const ImageFeatures& features, bool is_trusted,
                             const Eigen::Isometry3d& T_map_cam, LandmarkMap& map,
                             FrameBudget& budget);
  /// At the image of this stamp the flight has been moved there.
  void noteShift(std::int64_t stamp_ns, const Revisit& revisit);

 private:
  void follow(const ImageFeatures& features, const Eigen::Vector3d& camera_map, bool has_map);
  void beginAnew(std::int64_t stamp_ns);
  bool wasCovered() const { return covered_from_ns_ != 0; }
  /// Of landmarks from before the camera was covered.
  bool isCarry(const PlaceSight& sight) const {
    return wasCovered() && sight.last_seen_ns < covered_from_ns_;
  }
  bool isElsewhere(const PlaceSight& sight) const;

  PlaceLook look_;
  PlaceSights sights_;
  std::optional<std::int64_t> known_since_ns_;  // see know()
  bool has_looked_ = false;                     // likewise
  std::int64_t known_from_ns_ = 0;  // for how long landmarks of an earlier visit agree; 0: none do
  std::optional<Eigen::Vector3d> last_camera_map_;
  bool is_another_camera_ = false;
  // Since the last image with landmarks of an earlier visit:
  std::int64_t located_ns_ = 0;       // when that was
  double way_m_ = 0;                  // the camera's
  std::int64_t covered_from_ns_ = 0;  // the first image with hardly a track; 0: there was none
  std::int64_t covered_to_ns_ = 0;    // the last one
  std::int64_t next_look_ns_ = 0;
};

}  // namespace ardrone_vslam
