// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/landmark_map.hpp"

#include <algorithm>

namespace ardrone_vslam {

LandmarkMap::LandmarkMap(const LandmarkMapConfig& config) : config_(config) {
  validate(config);
}

std::uint32_t LandmarkMap::add(const Landmark& landmark) {
  const std::uint32_t id = next_id_++;
  index_of_id_.emplace(id, landmarks_.size());
  landmarks_.push_back(landmark);
  landmarks_.back().id = id;
  return id;
}

void LandmarkMap::remove(std::uint32_t id) {
  const auto entry = index_of_id_.find(id);
  if (entry == index_of_id_.end()) return;
  const std::size_t hole = entry->second;
  index_of_id_.erase(entry);
  if (hole + 1 != landmarks_.size()) {
    landmarks_[hole] = landmarks_.back();
    index_of_id_[landmarks_[hole].id] = hole;
  }
  landmarks_.pop_back();
}

int LandmarkMap::enforceCap() {
  const auto cap = static_cast<std::size_t>(config_.max_landmarks);
  if (landmarks_.size() <= cap) return 0;
  // A tenth of the cap at once, so that a full map does not sort at every frame.
  const std::size_t surplus = landmarks_.size() - cap + cap / 10;
  std::vector<std::pair<std::int64_t, std::uint32_t>> age;
  age.reserve(landmarks_.size());
  for (const Landmark& landmark : landmarks_) age.emplace_back(landmark.last_seen_ns, landmark.id);
  std::nth_element(age.begin(), age.begin() + static_cast<std::ptrdiff_t>(surplus), age.end());
  std::sort(age.begin(), age.begin() + static_cast<std::ptrdiff_t>(surplus));
  for (std::size_t i = 0; i < surplus; ++i) remove(age[i].second);
  return static_cast<int>(surplus);
}

const Landmark* LandmarkMap::find(std::uint32_t id) const {
  const auto entry = index_of_id_.find(id);
  return entry == index_of_id_.end() ? nullptr : &landmarks_[entry->second];
}

}  // namespace ardrone_vslam
