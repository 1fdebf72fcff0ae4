// SPDX-License-Identifier: BSD-3-Clause
#include "matching/list_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

int smallest(const std::uint16_t* distances_bits, std::size_t count) {
  std::int16_t least = kNoDistance_bits;  // signed: every x86-64 has its minimum as a vector
  for (std::size_t k = 0; k < count; ++k)
    least = std::min(least, static_cast<std::int16_t>(distances_bits[k]));
  return least;
}

}  // namespace

int ListSearch::nearestCentre(const Descriptor& descriptor,
                              const std::vector<Descriptor>& centres) {
  distances_bits_.resize(centres.size());
  kernels::kernelsInUse().hamming_distances(descriptor.words.data(), centres[0].words.data(),
                                            centres.size(), distances_bits_.data());
  const int least = smallest(distances_bits_.data(), distances_bits_.size());
  const auto nearest = std::find(distances_bits_.begin(), distances_bits_.end(), least);
  return static_cast<int>(nearest - distances_bits_.begin());
}

void ListSearch::chooseLists(const Descriptor& query, const std::vector<Descriptor>& centres,
                             std::size_t probes, int* chosen) {
  const std::size_t count = centres.size();
  kernels::kernelsInUse().hamming_distances(query.words.data(), centres[0].words.data(), count,
                                            distances_bits_.data());
  // The `probes` smallest by counting: all below a limit, and the first ones at the limit.
  std::array<std::uint32_t, kNoDistance_bits> at_distance{};
  for (std::size_t k = 0; k < count; ++k) ++at_distance[distances_bits_[k]];
  std::size_t limit = 0;
  std::size_t below = 0;
  while (below + at_distance[limit] < probes) below += at_distance[limit++];
  // Without a branch on the distance, which could not be predicted: a place is written to until
  // what it holds counts.
  std::size_t taken = 0;
  for (std::size_t k = 0; k < count; ++k) {
    chosen[taken] = static_cast<int>(k);
    taken += distances_bits_[k] < limit ? 1U : 0U;
  }
  for (std::size_t k = 0; taken < probes; ++k) {
    if (distances_bits_[k] == limit) chosen[taken++] = static_cast<int>(k);
  }
}

void ListSearch::sortByList(std::size_t list_count, std::size_t query_count, std::size_t probes) {
  first_of_list_.assign(list_count + 1, 0);
  const std::size_t pairs = query_count * probes;
  for (std::size_t pair = 0; pair < pairs; ++pair)
    ++first_of_list_[static_cast<std::size_t>(chosen_lists_[pair]) + 1];
  for (std::size_t l = 1; l < first_of_list_.size(); ++l)
    first_of_list_[l] += first_of_list_[l - 1];
  fill_of_list_.assign(first_of_list_.begin(), first_of_list_.end() - 1);
  query_of_pair_.resize(pairs);
  for (std::size_t q = 0; q < query_count; ++q) {
    for (std::size_t p = 0; p < probes; ++p) {
      const auto list = static_cast<std::size_t>(chosen_lists_[q * probes + p]);
      query_of_pair_[fill_of_list_[list]++] = static_cast<int>(q);
    }
  }
}

void ListSearch::searchList(const DescriptorList& list, const std::vector<Descriptor>& queries,
                            std::size_t begin, std::size_t end, std::vector<BestTwo>& best) {
  const std::size_t count = list.ids.size();
  if (count == 0) return;
  for (std::size_t pair = begin; pair < end; ++pair) {
    const auto q = static_cast<std::size_t>(query_of_pair_[pair]);
    kernels::kernelsInUse().hamming_distances(
        queries[q].words.data(), list.descriptors[0].words.data(), count, distances_bits_.data());
    // Most lists hold nothing that matters; an equally near entry may have a lower id.
    BestTwo found = best[q];
    const int least = smallest(distances_bits_.data(), count);
    if (least >= found.second_distance_bits && least != found.distance_bits) continue;
    for (std::size_t k = 0; k < count; ++k) {
      if (distances_bits_[k] <= found.second_distance_bits)
        found.offer(list.ids[k], distances_bits_[k]);
    }
    best[q] = found;
  }
}

void ListSearch::search(const std::vector<Descriptor>& centres,
                        const std::vector<DescriptorList>& lists,
                        const std::vector<Descriptor>& queries, int probes,
                        std::vector<BestTwo>& best) {
  assert(probes >= 1 && "a search probes at least one list");
  const std::size_t probed = std::min(static_cast<std::size_t>(probes), lists.size());
  std::size_t longest = centres.size();
  for (const DescriptorList& list : lists) longest = std::max(longest, list.ids.size());
  distances_bits_.resize(longest);
  best.assign(queries.size(), BestTwo{});
  // One place more, which choosing writes to (see there).
  chosen_lists_.resize(queries.size() * probed + 1);
  for (std::size_t q = 0; q < queries.size(); ++q)
    chooseLists(queries[q], centres, probed, chosen_lists_.data() + q * probed);
  sortByList(lists.size(), queries.size(), probed);
  for (std::size_t l = 0; l < lists.size(); ++l)
    searchList(lists[l], queries, first_of_list_[l], first_of_list_[l + 1], best);
}

}  // namespace ardrone_vslam
