// SPDX-License-Identifier: BSD-3-Clause
#include "matching/descriptor_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "matching/hamming.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

using Content = std::map<int, Descriptor>;

constexpr int kAllLists = 1 << 20;

Descriptor randomDescriptor(std::mt19937_64& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.words) word = random();
  return descriptor;
}

Descriptor flipped(const Descriptor& original, int bits, std::mt19937_64& random) {
  Descriptor descriptor = original;
  for (int i = 0; i < bits; ++i)
    descriptor.words[random() % 8] ^= std::uint64_t{1} << (random() % 64);
  return descriptor;
}

const Descriptor& anyOf(const std::vector<Descriptor>& descriptors, std::mt19937_64& random) {
  return descriptors[static_cast<std::size_t>(random() % descriptors.size())];
}

/// Like those of images: many near a few hundred kinds, a fifth like nothing else, some twice.
std::vector<Descriptor> clusteredDescriptors(int count, std::mt19937_64& random) {
  std::vector<Descriptor> kinds(300);
  for (Descriptor& kind : kinds) kind = randomDescriptor(random);
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < count; ++i) {
    if (i % 10 == 9) {
      descriptors.push_back(anyOf(descriptors, random));
    } else if (i % 5 == 4) {
      descriptors.push_back(randomDescriptor(random));
    } else {
      descriptors.push_back(flipped(anyOf(kinds, random), 120, random));
    }
  }
  return descriptors;
}

std::vector<Descriptor> queriesNear(const std::vector<Descriptor>& descriptors, int count,
                                    std::mt19937_64& random) {
  std::vector<Descriptor> queries;
  for (int i = 0; i < count; ++i)
    queries.push_back(flipped(anyOf(descriptors, random), 60, random));
  return queries;
}

std::vector<IndexEntry> entriesOf(const Content& content) {
  std::vector<IndexEntry> entries;
  for (const auto& [id, descriptor] : content) entries.push_back({id, descriptor});
  return entries;
}

std::vector<BestTwo> bruteForce(const Content& content, const std::vector<Descriptor>& queries) {
  std::vector<BestTwo> best(queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q) {
    for (const auto& [id, descriptor] : content)
      best[q].offer(id, hammingDistance(queries[q], descriptor));
  }
  return best;
}

std::vector<BestTwo> search(DescriptorIndex& index, const std::vector<Descriptor>& queries,
                            int probes) {
  std::vector<BestTwo> best(3);  // of an earlier search
  index.search(queries, probes, best);
  return best;
}

void expectEqual(const std::vector<BestTwo>& a, const std::vector<BestTwo>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].index, b[i].index) << i;
    ASSERT_EQ(a[i].distance_bits, b[i].distance_bits) << i;
    ASSERT_EQ(a[i].second_distance_bits, b[i].second_distance_bits) << i;
  }
}

/// Inserts and removes at random, growing to about 3000 entries and shrinking to a few.
template <class AfterEach>
void liveALife(DescriptorIndex& index, Content& content, unsigned seed, AfterEach&& after_each) {
  std::mt19937_64 random(seed);
  const auto descriptors = clusteredDescriptors(5000, random);
  int next_id = 0;
  for (int step = 0; step < 10000; ++step) {
    const bool grows = step < 5000 ? random() % 5 != 0 : random() % 5 == 0;
    if (grows && next_id < 5000) {
      const int id = (next_id++ * 1237) % 5000;  // each once, in no order
      content[id] = descriptors[static_cast<std::size_t>(id)];
      index.insert({id, content[id]});
    } else if (!content.empty()) {
      auto gone = content.lower_bound(static_cast<int>(random() % 5000));
      if (gone == content.end()) gone = content.begin();
      index.remove(gone->first);
      content.erase(gone);
    }
    after_each(step);
  }
}

TEST(DescriptorIndex, WithAllListsProbedItEqualsBruteForceThroughItsLife) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed + 1);
    DescriptorIndex index;
    Content content;
    int most_lists = 0;
    liveALife(index, content, seed, [&](int step) {
      most_lists = std::max(most_lists, index.listCount());
      if (step % 250 != 0) return;
      ASSERT_EQ(index.size(), content.size());
      std::vector<Descriptor> queries{randomDescriptor(random)};
      for (const auto& entry : content) {
        if (random() % 40 == 0) queries.push_back(flipped(entry.second, 30, random));
      }
      expectEqual(search(index, queries, kAllLists), bruteForce(content, queries));
      expectEqual(search(index, queries, index.listCount()), bruteForce(content, queries));
    });
    EXPECT_GE(most_lists, 16) << "the lists have grown in number";
    EXPECT_LT(index.listCount(), most_lists) << "and fewer again";
  }
}

TEST(DescriptorIndex, EqualDistancesGoToTheLowestId) {
  std::mt19937_64 random(5);
  const Descriptor twin = randomDescriptor(random);
  DescriptorIndex index;
  for (const int id : {9, 4, 700, 5, 12}) index.insert({id, twin});
  for (int id = 1000; id < 1600; ++id) index.insert({id, randomDescriptor(random)});
  for (const int probes : {1, 2, kAllLists}) {
    const BestTwo best = search(index, {twin}, probes)[0];
    EXPECT_EQ(best.index, 4);
    EXPECT_EQ(best.distance_bits, 0);
    EXPECT_EQ(best.second_distance_bits, 0);
  }
  index.remove(4);
  EXPECT_EQ(search(index, {twin}, 1)[0].index, 5);
}

TEST(DescriptorIndex, TheSameCallsGiveTheSameAnswersWhatTheIndexDidBeforeRebuilding) {
  DescriptorIndex lived;
  DescriptorIndex again;
  Content content;
  Content same_content;
  liveALife(lived, content, 8, [](int) {});
  // Ended small: filled up again, one by one here, and at once there.
  std::mt19937_64 random(9);
  const auto descriptors = clusteredDescriptors(3000, random);
  liveALife(again, same_content, 8, [](int) {});
  DescriptorIndex fresh;
  for (int i = 0; i < 3000; ++i) {
    const IndexEntry entry{10000 + i, descriptors[static_cast<std::size_t>(i)]};
    content[entry.id] = entry.descriptor;
    lived.insert(entry);
    again.insert(entry);
  }
  fresh.insert(entriesOf(content));
  const auto queries = queriesNear(descriptors, 300, random);
  expectEqual(search(lived, queries, 2), search(again, queries, 2));
  // One by one the centres come from the smaller map of the last rebuild; drawn anew they depend
  // on the present entries only.
  lived.rebuild();
  fresh.rebuild();
  EXPECT_EQ(lived.listCount(), fresh.listCount());
  for (const int probes : {1, 2, 5}) {
    expectEqual(search(lived, queries, probes), search(fresh, queries, probes));
  }
}

TEST(DescriptorIndex, EntriesInsertedLaterAreFoundAsWellAsThoseOfARebuild) {
  std::mt19937_64 random(3);
  const auto descriptors = clusteredDescriptors(4000, random);
  const auto queries = queriesNear(descriptors, 1000, random);
  DescriptorIndex index;
  Content content;
  for (int i = 0; i < 4000; ++i) {
    content[i] = descriptors[static_cast<std::size_t>(i)];
    index.insert({i, content[i]});
  }
  const auto exact = bruteForce(content, queries);
  const auto recall = [&] {
    const auto found = search(index, queries, 8);
    int hits = 0;
    for (std::size_t q = 0; q < queries.size(); ++q) {
      EXPECT_GE(found[q].distance_bits, exact[q].distance_bits);
      EXPECT_GE(found[q].second_distance_bits, exact[q].second_distance_bits);
      hits += found[q].distance_bits == exact[q].distance_bits ? 1 : 0;
    }
    return hits / 1000.0;
  };
  const double incremental = recall();
  index.rebuild();
  const double rebuilt = recall();
  EXPECT_GE(incremental, 0.88) << "8 lists of 32 or more";
  EXPECT_GE(rebuilt, 0.88);
  EXPECT_LT(search(index, queries, 1)[0].distance_bits, 513) << "one probe finds something";
}

TEST(DescriptorIndex, LaidOutAndFilledItIsWhatARebuildMakes) {
  std::mt19937_64 random(6);
  const auto descriptors = clusteredDescriptors(3000, random);
  const auto queries = queriesNear(descriptors, 300, random);
  Content content;
  std::vector<int> ids;
  for (int i = 0; i < 3000; ++i) {
    ids.push_back((i * 1237) % 3000);
    content[i] = descriptors[static_cast<std::size_t>(i)];
  }
  DescriptorIndex rebuilt;
  rebuilt.insert(entriesOf(content));

  DescriptorIndex filled;
  filled.insert({7, descriptors[7]});  // forgotten
  std::vector<Descriptor> centres;
  for (const int id : DescriptorIndex::centresOf(ids)) centres.push_back(content[id]);
  filled.layOut(centres);
  EXPECT_EQ(filled.size(), 0U);
  for (const int id : ids) {
    filled.insert({id, content[id]});
    ASSERT_EQ(filled.listCount(), rebuilt.listCount()) << "not rebuilt on the way";
    if (id % 3 != 0) continue;  // removed on the way, they come again
    filled.remove(id);
    filled.insert({id, content[id]});
  }
  EXPECT_TRUE(filled.isRightSizeFor(filled.size()));
  EXPECT_FALSE(filled.isRightSizeFor(5000));
  EXPECT_FALSE(filled.isRightSizeFor(300));
  for (const int probes : {1, 3, kAllLists})
    expectEqual(search(filled, queries, probes), search(rebuilt, queries, probes));
}

TEST(DescriptorIndex, AQuerysAnswerDoesNotDependOnTheOthers) {
  std::mt19937_64 random(4);
  const auto descriptors = clusteredDescriptors(2000, random);
  const auto queries = queriesNear(descriptors, 50, random);
  DescriptorIndex index;
  std::vector<IndexEntry> entries;
  for (int i = 0; i < 2000; ++i) entries.push_back({i, descriptors[static_cast<std::size_t>(i)]});
  index.insert(entries);
  ASSERT_GT(index.listCount(), 8);
  const auto together = search(index, queries, 3);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    SCOPED_TRACE(q);
    expectEqual(search(index, {queries[q]}, 3), {together[q]});
  }
}

TEST(DescriptorIndex, EmptyAndEmptiedIndexesAnswerNothing) {
  std::mt19937_64 random(6);
  DescriptorIndex index;
  EXPECT_TRUE(search(index, {}, 32).empty());
  EXPECT_EQ(search(index, {randomDescriptor(random)}, 32)[0].index, -1);
  index.insert({7, randomDescriptor(random)});
  index.insert(std::vector<IndexEntry>{});
  index.remove(8);
  ASSERT_EQ(index.size(), 1U);
  ASSERT_NE(index.find(7), nullptr);
  EXPECT_EQ(search(index, {*index.find(7)}, 1)[0].index, 7);
  EXPECT_EQ(search(index, {*index.find(7)}, 1)[0].second_distance_bits, kNoDistance_bits);
  index.remove(7);
  EXPECT_EQ(index.find(7), nullptr);
  EXPECT_EQ(index.size(), 0U);
  index.rebuild();
  EXPECT_EQ(search(index, {randomDescriptor(random)}, 32)[0].index, -1);
}

}  // namespace
}  // namespace ardrone_vslam::test
