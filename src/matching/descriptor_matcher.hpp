// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/instruction_set.hpp"
#include "matching/hamming.hpp"
#include "matching/match_acceptance.hpp"

namespace ardrone_vslam {

/// A query and the train descriptor that it was found to be.
struct DescriptorMatch {
  int query = -1;                        ///< index into the query descriptors
  int train = -1;                        ///< index into the train descriptors
  int distance_bits = kNoDistance_bits;  ///< Hamming distance of the two, 0..512
  int second_distance_bits =
      kNoDistance_bits;  ///< of the query's second nearest; kNoDistance_bits: only one candidate
};

/// Compares every query with every train descriptor (thesis 4.1.4). A match is the nearest train
/// descriptor, of equally near ones that with the lowest index, if accept() holds; with
/// `cross_check` the query must also be the nearest to the train descriptor, of equally near
/// queries the one with the lowest index.
/// @param out  the matches by ascending query index; its capacity is used as working memory, so
/// that a call with no
///     more queries than before does not allocate
/// @param set  one of supportedInstructionSets(); the matches do not depend on it
/// Cost: one Hamming distance for each pair.
void matchExact(const std::vector<Descriptor>& query, const std::vector<Descriptor>& train,
                const MatcherConfig& config, std::vector<DescriptorMatch>& out,
                InstructionSet set = instructionSetInUse().set);

}  // namespace ardrone_vslam
