// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "ardrone_vslam/frame_result.hpp"
#include "ardrone_vslam/parameters.hpp"
#include "map/landmark_map.hpp"
#include "matching/descriptor_matcher.hpp"
#include "matching/match_acceptance.hpp"

namespace ardrone_vslam {

/// Matches features and landmarks by their descriptors alone, wherever the camera may be.
class GlobalMatcher {
 public:
  /// @param index_probes  see DescriptorIndex::search
  GlobalMatcher(const MatcherConfig& config, int index_probes)
      : config_(config), index_probes_(index_probes) {}

  /// @param taken  the frame's features that are not to be matched
  /// @param method  kExact, or kIndexed if the map's index is up to date; both give the same but
  /// for what the index misses
  /// @param unseen_since_ns  landmarks seen since then are no candidates; in an index they hide
  /// older ones that look alike
  /// @return matches that accept() holds for and, with cross_check, that are the best from both
  ///   sides: query is the feature, train the index of the landmark; by ascending feature. Valid
  ///   until the next call.
  const std::vector<DescriptorMatch>& match(
      const ImageFeatures& features, const std::vector<bool>& taken, LandmarkMap& map,
      MatchMethod method, std::int64_t unseen_since_ns = std::numeric_limits<std::int64_t>::max());

 private:
  void matchByIndex(LandmarkMap& map, std::int64_t unseen_since_ns);
  void matchAll(const LandmarkMap& map, std::int64_t unseen_since_ns);
  bool isNearestTo(const DescriptorBits& landmark, std::size_t query);

  MatcherConfig config_;
  int index_probes_;
  std::vector<Descriptor> queries_;
  std::vector<int> feature_of_query_;
  std::vector<Descriptor> landmarks_;
  std::vector<int> index_of_landmark_;
  std::vector<BestTwo> best_;
  std::vector<std::uint16_t> distances_bits_;
  std::vector<DescriptorMatch> matches_;
};

}  // namespace ardrone_vslam
