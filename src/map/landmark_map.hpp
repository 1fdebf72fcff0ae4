// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "map/landmark_columns.hpp"
#include "map/landmark_ids.hpp"
#include "map/triangulation.hpp"
#include "matching/descriptor_index.hpp"
#include "matching/id_table.hpp"

namespace ardrone_vslam {

/// Storage of landmarks with stable ids.
class LandmarkMap {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit LandmarkMap(const LandmarkMapConfig& config, const LandmarkIds& ids = LandmarkIds());

  /// Stores a landmark under an id that no other one here has (its `id` is ignored). O(1).
  std::uint32_t add(const Landmark& landmark);
  /// Removes by id; unknown ids are ignored. O(1).
  void remove(std::uint32_t id);
  /// Another cap. @throws ConfigError
  void limit(const LandmarkMapConfig& config) {
    validate(config);
    config_ = config;
  }
  /// Removes the landmarks of leastWorth() until the cap holds. @return how many were removed.
  int enforceCap();

  /// All landmarks, dense; order changes only by remove (the last one takes the place).
  const Landmarks& all() const { return landmarks_; }
  /// Number of landmarks.
  std::size_t size() const { return landmarks_.size(); }
  /// Takes the memory for the cap, and for those that one image adds before some go, now, so
  /// that nothing is moved while the map grows; without the index, which small maps never need,
  /// and the thesis's first rays.
  void reserve();
  /// For changes; they must be made before columns() or advanceIndex() is called next.
  /// @param index  into all()
  Landmark& at(std::size_t index);
  /// For changes that leave the descriptor as it is.
  Landmark& atPlace(std::size_t index);
  /// One more view in which the landmark should have been seen and was not. @return times_missed
  int addMiss(std::size_t index) { return ++landmarks_.change(index).times_missed; }
  /// One more image that speaks against the landmark. @return times_failed
  int addFailure(std::size_t index) { return ++landmarks_.change(index).times_failed; }
  /// Its place in all(). @pre there is one of this id
  std::size_t indexOf(std::uint32_t id) const { return index_of_id_.at(id); }
  /// Keeps the ray by which a landmark was first seen; without it, a landmark takes none.
  void setFirstRay(std::uint32_t id, const Ray& ray) { first_ray_of_id_.set(id, ray); }
  /// @return nullptr when none is kept
  const Ray* firstRay(std::uint32_t id) const { return first_ray_of_id_.find(id); }
  /// @return nullptr when there is no landmark of this id
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
  Landmarks landmarks_;
  IdTable<std::uint32_t> index_of_id_;  // into landmarks_
  IdTable<Ray> first_ray_of_id_;
  LandmarkIds ids_;

  LandmarkColumns columns_;
  DescriptorIndex index_;
  bool index_is_laid_out_ = false;
  std::vector<std::uint8_t> stale_;               // of each landmark, bits of Stale
  std::vector<std::uint32_t> stale_for_columns_;  // indices into landmarks_, or beyond its end
  std::vector<std::uint32_t> stale_for_index_;    // ids, also of landmarks removed since
};

}  // namespace ardrone_vslam
