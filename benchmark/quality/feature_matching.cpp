// SPDX-License-Identifier: BSD-3-Clause
#include "feature_methods.hpp"
#include "matching/descriptor_matcher.hpp"

namespace ardrone_vslam::quality {

std::vector<IndexPair> matchFeatures(const FeatureSet& a, const FeatureSet& b) {
  MatcherConfig config;
  config.max_hamming_bits = kNoDistance_bits - 1;
  std::vector<DescriptorMatch> found;
  matchExact(a.descriptors, b.descriptors, config, found);
  std::vector<IndexPair> matches;
  for (const auto& match : found) matches.emplace_back(match.query, match.train);
  return matches;
}

}  // namespace ardrone_vslam::quality
