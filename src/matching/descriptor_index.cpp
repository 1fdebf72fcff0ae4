// SPDX-License-Identifier: BSD-3-Clause
#include "matching/descriptor_index.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

/// Mean length of the lists. With 100,000 entries of real images 1024 lists of about 100 served
/// best: more lists cost more for the centres than they save.
constexpr std::size_t kLongestMean = 128;
constexpr std::size_t kShortestMean = 16;

/// Entries with the smallest hashes are the sample (finaliser of splitmix64, a bijection: no two
/// ids share a hash).
std::uint64_t hashOf(int id) {
  std::uint64_t x = static_cast<std::uint64_t>(id) + 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::size_t listsFor(std::size_t entries) {
  std::size_t lists = 1;
  while (lists * kLongestMean < entries) lists *= 2;
  return lists;
}

int smallest(const std::uint16_t* distances_bits, std::size_t count) {
  std::int16_t least = kNoDistance_bits;  // signed: every x86-64 has its minimum as a vector
  for (std::size_t k = 0; k < count; ++k)
    least = std::min(least, static_cast<std::int16_t>(distances_bits[k]));
  return least;
}

}  // namespace

DescriptorIndex::DescriptorIndex() : centres_(1), lists_(1) {}

bool DescriptorIndex::isSizeOutOfRange(std::size_t entries) const {
  const std::size_t lists = lists_.size();
  return entries > lists * kLongestMean || (lists > 1 && entries < lists * kShortestMean);
}

int DescriptorIndex::nearestList(const Descriptor& descriptor) {
  distances_bits_.resize(centres_.size());
  kernels::kernelsInUse().hamming_distances(descriptor.words.data(), centres_[0].words.data(),
                                            centres_.size(), distances_bits_.data());
  const int least = smallest(distances_bits_.data(), distances_bits_.size());
  const auto nearest = std::find(distances_bits_.begin(), distances_bits_.end(), least);
  return static_cast<int>(nearest - distances_bits_.begin());
}

void DescriptorIndex::append(int list, int id, const Descriptor& descriptor) {
  List& to = lists_[static_cast<std::size_t>(list)];
  place_of_id_[id] = {list, static_cast<int>(to.ids.size())};
  to.ids.push_back(id);
  to.descriptors.push_back(descriptor);
}

void DescriptorIndex::insert(const IndexEntry& entry) {
  assert(entry.id >= 0 && find(entry.id) == nullptr && "ids are positive and used once");
  append(nearestList(entry.descriptor), entry.id, entry.descriptor);
  rebuildIfNeeded();
}

void DescriptorIndex::insert(const std::vector<IndexEntry>& entries) {
  const bool will_rebuild = is_rebuilt_by_itself_ && isSizeOutOfRange(size() + entries.size());
  for (const IndexEntry& entry : entries) {
    assert(entry.id >= 0 && find(entry.id) == nullptr && "ids are positive and used once");
    append(will_rebuild ? 0 : nearestList(entry.descriptor), entry.id, entry.descriptor);
  }
  if (will_rebuild) rebuild();
}

void DescriptorIndex::remove(int id) {
  const auto entry = place_of_id_.find(id);
  if (entry == place_of_id_.end()) return;
  const Place hole = entry->second;
  place_of_id_.erase(entry);
  List& list = lists_[static_cast<std::size_t>(hole.list)];
  const auto position = static_cast<std::size_t>(hole.position);
  if (position + 1 != list.ids.size()) {
    list.ids[position] = list.ids.back();
    list.descriptors[position] = list.descriptors.back();
    place_of_id_[list.ids[position]].position = hole.position;
  }
  list.ids.pop_back();
  list.descriptors.pop_back();
  rebuildIfNeeded();
}

void DescriptorIndex::rebuildIfNeeded() {
  if (is_rebuilt_by_itself_ && isSizeOutOfRange(size())) rebuild();
}

std::vector<int> DescriptorIndex::centresOf(const std::vector<int>& ids) {
  std::vector<std::pair<std::uint64_t, int>> sample;
  sample.reserve(ids.size());
  for (const int id : ids) sample.emplace_back(hashOf(id), id);
  const std::size_t count = std::min(listsFor(ids.size()), sample.size());
  const auto end = sample.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(sample.begin(), end, sample.end());
  std::sort(sample.begin(), end);
  std::vector<int> chosen;
  for (auto entry = sample.begin(); entry != end; ++entry) chosen.push_back(entry->second);
  return chosen;
}

void DescriptorIndex::layOut(const std::vector<Descriptor>& centres) {
  assert(!centres.empty() && "an index has at least one list");
  centres_ = centres;
  lists_.assign(centres.size(), List{});
  place_of_id_.clear();
  is_rebuilt_by_itself_ = false;
}

void DescriptorIndex::rebuild() {
  std::vector<int> ids;
  ids.reserve(size());
  for (const auto& entry : place_of_id_) ids.push_back(entry.first);
  std::vector<Descriptor> centres;
  for (const int id : centresOf(ids)) centres.push_back(*find(id));
  centres.resize(listsFor(size()));  // of an empty index: one list about any centre
  centres_ = std::move(centres);
  const std::vector<List> old = std::exchange(lists_, std::vector<List>(centres_.size()));
  for (const List& list : old) {
    for (std::size_t k = 0; k < list.ids.size(); ++k)
      append(nearestList(list.descriptors[k]), list.ids[k], list.descriptors[k]);
  }
  is_rebuilt_by_itself_ = true;
}

const Descriptor* DescriptorIndex::find(int id) const {
  const auto entry = place_of_id_.find(id);
  if (entry == place_of_id_.end()) return nullptr;
  const List& list = lists_[static_cast<std::size_t>(entry->second.list)];
  return &list.descriptors[static_cast<std::size_t>(entry->second.position)];
}

void DescriptorIndex::chooseLists(const Descriptor& query, std::size_t probes, int* chosen) {
  const std::size_t count = centres_.size();
  kernels::kernelsInUse().hamming_distances(query.words.data(), centres_[0].words.data(), count,
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

void DescriptorIndex::sortByList(std::size_t query_count, std::size_t probes) {
  first_of_list_.assign(lists_.size() + 1, 0);
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

void DescriptorIndex::searchList(const List& list, const std::vector<Descriptor>& queries,
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

void DescriptorIndex::search(const std::vector<Descriptor>& queries, int probes,
                             std::vector<BestTwo>& best) {
  assert(probes >= 1 && "a search probes at least one list");
  const std::size_t probed = std::min(static_cast<std::size_t>(probes), lists_.size());
  std::size_t longest = centres_.size();
  for (const List& list : lists_) longest = std::max(longest, list.ids.size());
  distances_bits_.resize(longest);
  best.assign(queries.size(), BestTwo{});
  // One place more, which choosing writes to (see there).
  chosen_lists_.resize(queries.size() * probed + 1);
  for (std::size_t q = 0; q < queries.size(); ++q)
    chooseLists(queries[q], probed, chosen_lists_.data() + q * probed);
  sortByList(queries.size(), probed);
  for (std::size_t l = 0; l < lists_.size(); ++l)
    searchList(lists_[l], queries, first_of_list_[l], first_of_list_[l + 1], best);
}

}  // namespace ardrone_vslam
