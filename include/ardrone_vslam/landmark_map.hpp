// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ardrone_vslam/descriptor_index.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/landmark_columns.hpp"
#include "ardrone_vslam/parameters.hpp"
#include "ardrone_vslam/triangulation.hpp"

namespace ardrone_vslam {

/// A point of the world with known position.
struct Landmark {
  std::uint32_t id = 0;                                    ///< never used again in one run
  std::uint32_t track_id = 0;                              ///< of the feature that saw it last
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();  ///< of the point; z is 0 in 2-D mode
  Eigen::Vector3d view_direction_map =
      Eigen::Vector3d::Zero();   ///< unit ray camera -> landmark when last described
  double seen_distance_m = 0;    ///< from the camera that saw it last; 0: not known
  double deviation_m = 0;        ///< sigma_l (5.19, 5.34)
  double depth_deviation_m = 0;  ///< along the ray of its last triangulation
  Ray first_ray;                 ///< of the first view, by which it was triangulated
  double parallax_rad = 0;       ///< between the first view and the one of its last triangulation
  double position_variance_m2 = 0;  ///< of the base position, per axis, when the landmark was made
                                    ///< (common drift, docs/data_path.md)
  std::uint32_t anchor_id = 0;      ///< constraint filter: the frame whose error it shares
  Eigen::Matrix3d covariance_m2 =
      Eigen::Matrix3d::Zero();  ///< constraint filter: beside that error
  Descriptor descriptor;        ///< as seen last
  double height_m =
      0;  ///< above the camera that saw it last; used in 2-D mode, where positions have no height
  int times_seen = 0;    ///< matches since it was made, that included
  int times_missed = 0;  ///< in view but not matched, since the last match
  int times_failed = 0;  ///< constraint filter: missed where others were found, or matched wrongly
  std::int64_t first_seen_ns = 0;  ///< stamp of the image that made it
  std::int64_t last_seen_ns = 0;   ///< stamp of the last image it was matched in
};

/// How large the map may become.
struct LandmarkMapConfig {
  int max_landmarks = 200000;
};

template <class Visitor>
void visitParameters(LandmarkMapConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"max_landmarks", "landmarks", 10, 10000000,
                      "cap of the map; the ones not seen for longest go first"},
        c.max_landmarks);
}

/// Storage of landmarks with stable ids.
class LandmarkMap {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit LandmarkMap(const LandmarkMapConfig& config);

  /// Stores a landmark under a new id (its `id` is ignored). O(1).
  std::uint32_t add(const Landmark& landmark);
  /// Removes by id; unknown ids are ignored. O(1).
  void remove(std::uint32_t id);
  /// Removes the landmarks not seen for longest until the cap holds. @return how many were removed.
  int enforceCap();

  /// All landmarks, dense; order changes only by remove (the last one takes the place).
  const std::vector<Landmark>& all() const { return landmarks_; }
  /// Number of landmarks.
  std::size_t size() const { return landmarks_.size(); }
  /// Takes the memory for so many landmarks now, so that nothing is moved while the map grows;
  /// without the index, which most flights never need, and 24 to 40 bytes of each landmark's id.
  void reserve(std::size_t landmarks);
  /// For changes; they must be made before columns() or advanceIndex() is called next.
  /// @param index  into all()
  Landmark& at(std::size_t index);
  /// For changes that leave the descriptor as it is.
  Landmark& atPlace(std::size_t index);
  /// One more view in which the landmark should have been seen and was not. @return times_missed
  int addMiss(std::size_t index) { return ++landmarks_[index].times_missed; }
  /// One more image that speaks against the landmark. @return times_failed
  int addFailure(std::size_t index) { return ++landmarks_[index].times_failed; }
  /// @return nullptr when there is none of this id
  const Landmark* find(std::uint32_t id) const;

  /// All landmarks as arrays for the projection near a camera, up to date; entry i belongs to
  /// all()[i]. O(changes since the last call); once in 256 m of flight O(size).
  const LandmarkColumns& columns(const Eigen::Vector3d& camera_map);
  /// Brings the index of all descriptors closer to the map: lays it out at the first call, as most
  /// flights never need it, or when the map has outgrown it; then enters at most kIndexStep of the
  /// landmarks that it lacks or that have changed. Cost: kIndexStep times one distance for each of
  /// its lists.
  /// @return whether index() is up to date now
  bool advanceIndex();
  /// Landmarks entered by one advanceIndex() at most.
  static constexpr int kIndexStep = 5000;
  /// Its ids are the landmarks'. @pre advanceIndex() has returned true since the last change
  /// (asserted)
  DescriptorIndex& index();
  /// Entries that advanceIndex() has yet to look at, also of landmarks removed since: at most twice
  /// as many as there are landmarks, and kIndexStep.
  std::size_t indexBacklog() const { return stale_for_index_.size(); }

 private:
  /// Which of the copies below a landmark has yet to be copied to.
  enum Stale : std::uint8_t { kStaleColumns = 1, kStaleIndex = 2 };
  void markStale(std::size_t index);
  void markStaleForColumns(std::size_t index);
  void markStaleForIndex(std::size_t index);
  void layOutIndex();
  void enter(const Landmark& landmark);

  LandmarkMapConfig config_;
  std::vector<Landmark> landmarks_;
  std::unordered_map<std::uint32_t, std::size_t> index_of_id_;
  std::uint32_t next_id_ = 1;

  LandmarkColumns columns_;
  DescriptorIndex index_;
  bool index_is_laid_out_ = false;
  std::vector<std::uint8_t> stale_;             // of each landmark, bits of Stale
  std::vector<std::size_t> stale_for_columns_;  // indices into landmarks_, or beyond its end
  std::vector<std::uint32_t> stale_for_index_;  // ids, also of landmarks removed since
};

}  // namespace ardrone_vslam
