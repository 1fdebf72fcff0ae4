// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "matching/match_acceptance.hpp"

namespace ardrone_vslam {

/// The entries around one centre of a DescriptorIndex.
struct DescriptorList {
  std::vector<Descriptor> descriptors;
  std::vector<int> ids;
};

/// Searches a DescriptorIndex's lists. Has working memory alone, kept from call to call.
class ListSearch {
 public:
  /// Its index; of equally near ones the first.
  int nearestCentre(const Descriptor& descriptor, const std::vector<Descriptor>& centres);
  /// See DescriptorIndex::search. @param lists  one for each centre
  void search(const std::vector<Descriptor>& centres, const std::vector<DescriptorList>& lists,
              const std::vector<Descriptor>& queries, int probes, std::vector<BestTwo>& best);

 private:
  void chooseLists(const Descriptor& query, const std::vector<Descriptor>& centres,
                   std::size_t probes, int* chosen);
  void sortByList(std::size_t list_count, std::size_t query_count, std::size_t probes);
  void searchList(const DescriptorList& list, const std::vector<Descriptor>& queries,
                  std::size_t begin, std::size_t end, std::vector<BestTwo>& best);

  std::vector<std::uint16_t> distances_bits_;
  std::vector<int> chosen_lists_;           // of each query, `probes` of them
  std::vector<std::size_t> first_of_list_;  // into query_of_pair_
  std::vector<std::size_t> fill_of_list_;
  std::vector<int> query_of_pair_;
};

}  // namespace ardrone_vslam
