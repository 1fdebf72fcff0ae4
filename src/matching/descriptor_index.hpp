// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/features.hpp"
#include "matching/id_table.hpp"
#include "matching/list_search.hpp"

namespace ardrone_vslam {

/// A descriptor under the number that a search answers with.
struct IndexEntry {
  int id = 0;             ///< 0 or greater
  Descriptor descriptor;  ///< what is compared
};

/// Nearest and second nearest among many descriptors, without comparing all: inverted lists. A
/// random sample of the entries are centres; each entry is kept in the list of the nearest centre
/// (of equally near ones the first), and a query is compared with the lists of the centres nearest
/// to it. Exact, and equal to brute force, when all lists are probed; otherwise the nearest is
/// missed now and then, never wrongly measured.
///
/// The result depends on the calls made and their order alone: the sample is drawn by a fixed hash
/// of the ids. Lists hold 16 to 128 entries in the mean; when the number of entries leaves that
/// range, twice (half) as many centres are drawn and all entries are sorted in anew. Not to be used
/// by two threads at a time.
class DescriptorIndex {
 public:
  DescriptorIndex();

  /// Cost: one distance for each list; a rebuild (see above) each time the size has doubled.
  /// @pre the id is not in the index (asserted)
  void insert(const IndexEntry& entry);
  /// The same for many: at most one rebuild.
  void insert(const std::vector<IndexEntry>& entries);
  /// Ids that are not there are ignored. O(a list), but for a rebuild when the size has fallen to
  /// an eighth.
  void remove(int id);
  /// The ids whose descriptors rebuild() of entries with these ids would choose as centres, in its
  /// order. O(ids).
  static std::vector<int> centresOf(const std::vector<int>& ids);
  /// Empties the index and gives it these centres, at least one, for entries to come: filled one by
  /// one, it is what rebuild() would make of them, without the whole cost at once. It is not
  /// rebuilt by itself any more, as half filled it is too small and who fills it knows the number:
  /// see isRightSizeFor().
  void layOut(const std::vector<Descriptor>& centres);
  /// Whether so many entries fill the lists as they should (see above).
  bool isRightSizeFor(std::size_t entries) const { return !isSizeOutOfRange(entries); }
  /// Draws new centres from the present entries, which alone decide the result.
  /// Cost: entries x lists distances, 0.1 to 0.2 s for 100,000 entries (0.5 s without vectors).
  void rebuild();

  /// Number of entries.
  std::size_t size() const { return list_of_id_.size(); }
  /// Number of inverted lists; so many probes make a search exact.
  int listCount() const { return static_cast<int>(centres_.size()); }
  /// @return nullptr when there is none of this id; valid until the index is changed. O(a list)
  const Descriptor* find(int id) const;

  /// Nearest and second nearest of each query among the lists probed; of equally near entries the
  /// one with the lowest id (BestTwo, whose index is the id).
  /// @param probes  lists compared with each query, at least 1; listCount() or more: exact
  /// @param best  as long as `queries`; nothing offered (-1) where the lists probed are empty
  /// Cost: listCount() + probes x entries a list distances for each query. Queries are sorted by
  /// list, so that each list is read once for all of them: give them together.
  void search(const std::vector<Descriptor>& queries, int probes, std::vector<BestTwo>& best) {
    search_.search(centres_, lists_, queries, probes, best);
  }

 private:
  bool isSizeOutOfRange(std::size_t entries) const;
  void rebuildIfNeeded();
  void append(int list, int id, const Descriptor& descriptor);
  /// Of an id in it.
  static std::size_t positionOf(int id, const DescriptorList& list);

  std::vector<Descriptor> centres_;
  std::vector<DescriptorList> lists_;
  IdTable<int> list_of_id_;  // its place there is looked for
  bool is_rebuilt_by_itself_ = true;
  ListSearch search_;
};

}  // namespace ardrone_vslam
