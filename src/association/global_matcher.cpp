// SPDX-License-Identifier: BSD-3-Clause
#include "association/global_matcher.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {

const std::vector<DescriptorMatch>& GlobalMatcher::match(const ImageFeatures& features,
                                                         const std::vector<bool>& taken,
                                                         LandmarkMap& map, MatchMethod method,
                                                         std::int64_t unseen_since_ns) {
  assert(method != MatchMethod::kGuided && "guided matching needs a view");
  queries_.clear();
  feature_of_query_.clear();
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (taken[f]) continue;
    queries_.push_back(features.descriptor[f]);
    feature_of_query_.push_back(static_cast<int>(f));
  }
  if (method == MatchMethod::kIndexed) {
    matchByIndex(map, unseen_since_ns);
  } else {
    matchAll(map, unseen_since_ns);
  }
  for (DescriptorMatch& match : matches_)
    match.query = feature_of_query_[static_cast<std::size_t>(match.query)];
  return matches_;
}

void GlobalMatcher::matchAll(const LandmarkMap& map, std::int64_t unseen_since_ns) {
  landmarks_.clear();
  index_of_landmark_.clear();
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Landmark& landmark = map.all()[i];
    if (landmark.last_seen_ns >= unseen_since_ns) continue;
    landmarks_.emplace_back(landmark.descriptor);
    index_of_landmark_.push_back(static_cast<int>(i));
  }
  matchExact(queries_, landmarks_, config_, matches_);
  for (DescriptorMatch& match : matches_)
    match.train = index_of_landmark_[static_cast<std::size_t>(match.train)];
}

void GlobalMatcher::matchByIndex(LandmarkMap& map, std::int64_t unseen_since_ns) {
  matches_.clear();
  map.index().search(queries_, index_probes_, best_);
  for (std::size_t q = 0; q < queries_.size(); ++q) {
    const BestTwo& best = best_[q];
    if (!accept(best, config_)) continue;
    const Landmark* landmark = map.find(static_cast<std::uint32_t>(best.index));
    if (landmark->last_seen_ns >= unseen_since_ns) continue;
    if (config_.cross_check && !isNearestTo(landmark->descriptor, q)) continue;
    const auto index = static_cast<int>(map.indexOf(landmark->id));
    matches_.push_back({static_cast<int>(q), index, best.distance_bits, best.second_distance_bits});
  }
}

bool GlobalMatcher::isNearestTo(const DescriptorBits& landmark, std::size_t query) {
  distances_bits_.resize(queries_.size());
  kernels::kernelsInUse().hamming_distances(landmark.words.data(), queries_[0].words.data(),
                                            queries_.size(), distances_bits_.data());
  const auto nearest = std::min_element(distances_bits_.begin(), distances_bits_.end());
  return nearest - distances_bits_.begin() == static_cast<std::ptrdiff_t>(query);
}

}  // namespace ardrone_vslam
