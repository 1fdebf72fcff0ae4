// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_map.hpp"

#include <algorithm>
#include <cassert>

#include "ardrone_vslam/landmark_worth.hpp"
#include "matching/growth.hpp"

namespace ardrone_vslam {

LandmarkMap::LandmarkMap(const LandmarkMapConfig& config, const LandmarkIds& ids)
    : config_(config), ids_(ids) {
  validate(config);
}

void LandmarkMap::reserve() {
  constexpr std::size_t kOfOneImage = 500;
  const std::size_t landmarks = static_cast<std::size_t>(config_.most()) + kOfOneImage;
  landmarks_.reserve(landmarks);
  index_of_id_.reserve(landmarks);
  columns_.reserve(landmarks);
  stale_.reserve(landmarks);
  stale_for_columns_.reserve(landmarks);
}

std::uint32_t LandmarkMap::add(const Landmark& landmark) {
  const std::uint32_t id = ids_.take(index_of_id_);
  index_of_id_.set(id, static_cast<std::uint32_t>(landmarks_.size()));
  landmarks_.push_back(landmark);
  landmarks_.change(landmarks_.size() - 1).id = id;
  appendTightly<std::uint8_t>(stale_, 0);
  markStale(landmarks_.size() - 1);
  return id;
}

void LandmarkMap::remove(std::uint32_t id) {
  const std::uint32_t* entry = index_of_id_.find(id);
  if (entry == nullptr) return;
  const std::size_t hole = *entry;
  index_of_id_.erase(id);
  first_ray_of_id_.erase(id);
  if (index_is_laid_out_) index_.remove(static_cast<int>(id));
  if (hole + 1 != landmarks_.size()) {
    landmarks_.change(hole) = Landmark(landmarks_.back());  // a copy, as the change may move it
    index_of_id_.set(landmarks_[hole].id, static_cast<std::uint32_t>(hole));
    stale_[hole] = static_cast<std::uint8_t>(stale_.back() & kStaleIndex);
    markStale(hole);
  }
  landmarks_.pop_back();
  stale_.pop_back();
}

Landmark& LandmarkMap::at(std::size_t index) {
  markStale(index);
  return landmarks_.change(index);
}

Landmark& LandmarkMap::atPlace(std::size_t index) {
  markStaleForColumns(index);
  return landmarks_.change(index);
}

void LandmarkMap::markStale(std::size_t index) {
  markStaleForColumns(index);
  if (index_is_laid_out_) markStaleForIndex(index);
}

void LandmarkMap::markStaleForColumns(std::size_t index) {
  std::uint8_t& stale = stale_[index];
  if ((stale & kStaleColumns) == 0)
    appendTightly(stale_for_columns_, static_cast<std::uint32_t>(index));
  stale |= kStaleColumns;
}

void LandmarkMap::markStaleForIndex(std::size_t index) {
  std::uint8_t& stale = stale_[index];
  if ((stale & kStaleIndex) != 0) return;
  stale |= kStaleIndex;
  appendTightly(stale_for_index_, landmarks_[index].id);
  if (stale_for_index_.size() <= 2 * landmarks_.size() + kIndexStep) return;
  // Most of it are landmarks that came and went while nobody needed the index.
  const auto is_gone = [this](std::uint32_t id) { return index_of_id_.count(id) == 0; };
  stale_for_index_.erase(std::remove_if(stale_for_index_.begin(), stale_for_index_.end(), is_gone),
                         stale_for_index_.end());
}

const LandmarkColumns& LandmarkMap::columns(const Eigen::Vector3d& camera_map) {
  columns_.resize(landmarks_.size());
  if (columns_.follow(camera_map)) {
    for (std::size_t i = 0; i < landmarks_.size(); ++i) columns_.set(i, landmarks_[i]);
  }
  for (const std::size_t i : stale_for_columns_) {
    if (i >= landmarks_.size()) continue;
    columns_.set(i, landmarks_[i]);
    stale_[i] = static_cast<std::uint8_t>(stale_[i] & ~kStaleColumns);
  }
  stale_for_columns_.clear();
  return columns_;
}

void LandmarkMap::layOutIndex() {
  std::vector<int> ids;
  ids.reserve(landmarks_.size());
  for (const Landmark& landmark : landmarks_) ids.push_back(static_cast<int>(landmark.id));
  std::vector<Descriptor> centres;
  for (const int id : DescriptorIndex::centresOf(ids))
    centres.emplace_back(find(static_cast<std::uint32_t>(id))->descriptor);
  if (centres.empty()) centres.resize(1);
  index_.layOut(centres);
  index_is_laid_out_ = true;
  stale_for_index_.clear();
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    stale_[i] = static_cast<std::uint8_t>(stale_[i] & ~kStaleIndex);
    markStaleForIndex(i);
  }
}

bool LandmarkMap::advanceIndex() {
  if (!index_is_laid_out_ || !index_.isRightSizeFor(landmarks_.size())) layOutIndex();
  for (int step = 0; step < kIndexStep && !stale_for_index_.empty(); ++step) {
    const std::uint32_t* entry = index_of_id_.find(stale_for_index_.back());
    stale_for_index_.pop_back();
    if (entry == nullptr) continue;
    std::uint8_t& stale = stale_[*entry];
    stale = static_cast<std::uint8_t>(stale & ~kStaleIndex);
    enter(landmarks_[*entry]);
  }
  return stale_for_index_.empty();
}

void LandmarkMap::enter(const Landmark& landmark) {
  const auto id = static_cast<int>(landmark.id);
  const Descriptor* known = index_.find(id);
  if (known != nullptr && *known == landmark.descriptor) return;
  index_.remove(id);
  index_.insert({id, Descriptor(landmark.descriptor)});
}

DescriptorIndex& LandmarkMap::index() {
  assert(index_is_laid_out_ && stale_for_index_.empty() && "the index is not up to date");
  return index_;
}

int LandmarkMap::enforceCap() {
  const auto cap = static_cast<std::size_t>(config_.most());
  if (landmarks_.size() <= cap) return 0;
  // A tenth of the cap at once, so that a full map does not sort at every frame.
  const std::size_t surplus = landmarks_.size() - cap + cap / 10;
  for (const std::uint32_t id : leastWorth(landmarks_, surplus)) remove(id);
  return static_cast<int>(surplus);
}

const Landmark* LandmarkMap::find(std::uint32_t id) const {
  const std::uint32_t* entry = index_of_id_.find(id);
  return entry == nullptr ? nullptr : &landmarks_[*entry];
}

}  // namespace ardrone_vslam
