// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/descriptor_matcher.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

/// Train descriptors compared in one go: 16 KB, which stay in the first-level cache while all
/// queries pass.
constexpr std::size_t kTile = 256;

/// `DescriptorMatch::query` of a query that is not the nearest to its best train descriptor.
constexpr int kNotMutual = -1;

BestTwo bestOf(const DescriptorMatch& match) {
  return {match.train, match.distance_bits, match.second_distance_bits};
}

/// Offers the train descriptors from `first` on, at most kTile, to every query and every query to
/// them.
void matchTile(const std::vector<Descriptor>& query, const std::vector<Descriptor>& train,
               std::size_t first, bool cross_check, std::vector<DescriptorMatch>& best_of_query) {
  const std::size_t count = std::min(kTile, train.size() - first);
  std::array<std::uint16_t, kTile> distances_bits;
  std::array<BestTwo, kTile> best_of_train;
  for (std::size_t q = 0; q < query.size(); ++q) {
    kernels::kernelsInUse().hamming_distances(query[q].words.data(), train[first].words.data(),
                                              count, distances_bits.data());
    BestTwo best = bestOf(best_of_query[q]);
    for (std::size_t t = 0; t < count; ++t)
      best.offer(static_cast<int>(first + t), distances_bits[t]);
    best_of_query[q].train = best.index;
    best_of_query[q].distance_bits = best.distance_bits;
    best_of_query[q].second_distance_bits = best.second_distance_bits;
    if (!cross_check) continue;
    for (std::size_t t = 0; t < count; ++t)
      best_of_train[t].offer(static_cast<int>(q), distances_bits[t]);
  }
  for (std::size_t q = 0; q < query.size(); ++q) {
    DescriptorMatch& match = best_of_query[q];
    const auto best_train = static_cast<std::size_t>(match.train);
    if (best_train < first) continue;  // judged with its own tile
    const int number = static_cast<int>(q);
    match.query =
        !cross_check || best_of_train[best_train - first].index == number ? number : kNotMutual;
  }
}

}  // namespace

void matchExact(const std::vector<Descriptor>& query, const std::vector<Descriptor>& train,
                const MatcherConfig& config, std::vector<DescriptorMatch>& out) {
  out.clear();
  if (train.empty()) return;
  // Until the end, out[q] is what is known of query q.
  out.resize(query.size());
  for (std::size_t first = 0; first < train.size(); first += kTile) {
    matchTile(query, train, first, config.cross_check, out);
  }
  const auto isNoMatch = [&config](const DescriptorMatch& match) {
    return match.query == kNotMutual || !accept(bestOf(match), config);
  };
  out.erase(std::remove_if(out.begin(), out.end(), isNoMatch), out.end());
}

}  // namespace ardrone_vslam
