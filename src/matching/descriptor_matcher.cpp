// SPDX-License-Identifier: BSD-3-Clause
#include "matching/descriptor_matcher.hpp"

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

/// A tile of train descriptors and the nearest query to each of them.
struct Tile {
  alignas(64) std::array<std::uint64_t, kTile * kernels::kHammingWords> words;
  std::size_t first = 0;
  std::size_t count = 0;
  std::array<int, kTile> distances_bits;
  std::array<int, kTile> queries;

  kernels::HammingTile view() const {
    return {words.data(), static_cast<int>(count), static_cast<int>(first)};
  }
};

void fill(const std::vector<Descriptor>& train, std::size_t first, Tile& tile) {
  tile.first = first;
  tile.count = std::min(kTile, train.size() - first);
  kernels::hammingTileWords(train[first].words.data(), static_cast<int>(tile.count),
                            tile.words.data());
  tile.distances_bits.fill(kNoDistance_bits);
  tile.queries.fill(kNotMutual);
}

/// Calls compare(query's number, what is known of it) for the queries first .. end - 1.
template <class Compare>
void forQueries(std::size_t first, std::size_t end, std::vector<DescriptorMatch>& best_of_query,
                Compare compare) {
  for (std::size_t q = first; q < end; ++q) {
    DescriptorMatch& match = best_of_query[q];
    kernels::HammingNearest nearest{match.train, match.distance_bits, match.second_distance_bits};
    compare(q, nearest);
    match.train = nearest.index;
    match.distance_bits = nearest.distance_bits;
    match.second_distance_bits = nearest.second_distance_bits;
  }
}

/// Compares both ways. The kernel numbers queries with 16 bits: it gets them in blocks.
void compareMutually(const kernels::Kernels& kernels, const std::vector<Descriptor>& query,
                     Tile& tile, std::vector<DescriptorMatch>& best_of_query) {
  constexpr std::size_t kBlock = 65536;
  for (std::size_t block = 0; block < query.size(); block += kBlock) {
    alignas(64) std::array<std::uint16_t, kTile> distances_bits;
    alignas(64) std::array<std::uint16_t, kTile> queries{};
    distances_bits.fill(static_cast<std::uint16_t>(kNoDistance_bits));
    forQueries(block, std::min(block + kBlock, query.size()), best_of_query,
               [&](std::size_t q, kernels::HammingNearest& nearest) {
                 kernels.hamming_mutual(query[q].words.data(),
                                        static_cast<std::uint16_t>(q - block), tile.view(), nearest,
                                        {distances_bits.data(), queries.data()});
               });
    for (std::size_t t = 0; t < tile.count; ++t) {
      if (distances_bits[t] >= tile.distances_bits[t]) continue;
      tile.distances_bits[t] = distances_bits[t];
      tile.queries[t] = static_cast<int>(block + queries[t]);
    }
  }
}

/// Marks the queries whose best train descriptor so far lies in this tile and is nearer to another.
void judge(const Tile& tile, bool cross_check, std::vector<DescriptorMatch>& best_of_query) {
  for (std::size_t q = 0; q < best_of_query.size(); ++q) {
    DescriptorMatch& match = best_of_query[q];
    const auto best_train = static_cast<std::size_t>(match.train);
    if (best_train < tile.first) continue;  // judged with its own tile
    const int number = static_cast<int>(q);
    match.query =
        !cross_check || tile.queries[best_train - tile.first] == number ? number : kNotMutual;
  }
}

}  // namespace

void matchExact(const std::vector<Descriptor>& query, const std::vector<Descriptor>& train,
                const MatcherConfig& config, std::vector<DescriptorMatch>& out,
                InstructionSet set) {
  out.clear();
  if (train.empty()) return;
  const kernels::Kernels kernels = kernels::kernelsFor(set);
  // Until the end, out[q] is what is known of query q.
  out.resize(query.size());
  Tile tile;
  for (std::size_t first = 0; first < train.size(); first += kTile) {
    fill(train, first, tile);
    if (config.cross_check) {
      compareMutually(kernels, query, tile, out);
    } else {
      forQueries(0, query.size(), out, [&](std::size_t q, kernels::HammingNearest& nearest) {
        kernels.hamming_nearest(query[q].words.data(), tile.view(), nearest);
      });
    }
    judge(tile, config.cross_check, out);
  }
  const auto isNoMatch = [&config](const DescriptorMatch& match) {
    const BestTwo best{match.train, match.distance_bits, match.second_distance_bits};
    return match.query == kNotMutual || !accept(best, config);
  };
  out.erase(std::remove_if(out.begin(), out.end(), isNoMatch), out.end());
}

}  // namespace ardrone_vslam
