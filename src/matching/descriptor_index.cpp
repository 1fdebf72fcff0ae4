// SPDX-License-Identifier: BSD-3-Clause
#include "matching/descriptor_index.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "matching/growth.hpp"

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

std::uint32_t keyOf(int id) {
  return static_cast<std::uint32_t>(id);
}

std::size_t listsFor(std::size_t entries) {
  std::size_t lists = 1;
  while (lists * kLongestMean < entries) lists *= 2;
  return lists;
}

}  // namespace

DescriptorIndex::DescriptorIndex() : centres_(1), lists_(1) {}

bool DescriptorIndex::isSizeOutOfRange(std::size_t entries) const {
  const std::size_t lists = lists_.size();
  return entries > lists * kLongestMean || (lists > 1 && entries < lists * kShortestMean);
}

void DescriptorIndex::append(int list, int id, const Descriptor& descriptor) {
  DescriptorList& to = lists_[static_cast<std::size_t>(list)];
  list_of_id_.set(keyOf(id), list);
  appendTightly(to.ids, id);
  appendTightly(to.descriptors, descriptor);
}

void DescriptorIndex::insert(const IndexEntry& entry) {
  assert(entry.id >= 0 && find(entry.id) == nullptr && "ids are positive and used once");
  append(search_.nearestCentre(entry.descriptor, centres_), entry.id, entry.descriptor);
  rebuildIfNeeded();
}

void DescriptorIndex::insert(const std::vector<IndexEntry>& entries) {
  const bool will_rebuild = is_rebuilt_by_itself_ && isSizeOutOfRange(size() + entries.size());
  for (const IndexEntry& entry : entries) {
    assert(entry.id >= 0 && find(entry.id) == nullptr && "ids are positive and used once");
    append(will_rebuild ? 0 : search_.nearestCentre(entry.descriptor, centres_), entry.id,
           entry.descriptor);
  }
  if (will_rebuild) rebuild();
}

void DescriptorIndex::remove(int id) {
  const int* entry = list_of_id_.find(keyOf(id));
  if (entry == nullptr) return;
  DescriptorList& list = lists_[static_cast<std::size_t>(*entry)];
  list_of_id_.erase(keyOf(id));
  const std::size_t position = positionOf(id, list);
  list.ids[position] = list.ids.back();
  list.descriptors[position] = list.descriptors.back();
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
  lists_.assign(centres.size(), DescriptorList{});
  list_of_id_.clear();
  is_rebuilt_by_itself_ = false;
}

void DescriptorIndex::rebuild() {
  std::vector<int> ids;
  ids.reserve(size());
  for (const DescriptorList& list : lists_) ids.insert(ids.end(), list.ids.begin(), list.ids.end());
  std::vector<Descriptor> centres;
  for (const int id : centresOf(ids)) centres.push_back(*find(id));
  centres.resize(listsFor(size()));  // of an empty index: one list about any centre
  centres_ = std::move(centres);
  const std::vector<DescriptorList> old =
      std::exchange(lists_, std::vector<DescriptorList>(centres_.size()));
  for (const DescriptorList& list : old) {
    for (std::size_t k = 0; k < list.ids.size(); ++k)
      append(search_.nearestCentre(list.descriptors[k], centres_), list.ids[k],
             list.descriptors[k]);
  }
  is_rebuilt_by_itself_ = true;
}

const Descriptor* DescriptorIndex::find(int id) const {
  const int* entry = list_of_id_.find(keyOf(id));
  if (entry == nullptr) return nullptr;
  const DescriptorList& list = lists_[static_cast<std::size_t>(*entry)];
  return &list.descriptors[positionOf(id, list)];
}

std::size_t DescriptorIndex::positionOf(int id, const DescriptorList& list) {
  const auto found = std::find(list.ids.begin(), list.ids.end(), id);
  return static_cast<std::size_t>(found - list.ids.begin());
}

}  // namespace ardrone_vslam
