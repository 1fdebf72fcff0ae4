// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <map>
#include <memory>
#include <opencv2/features2d.hpp>
#include <opencv2/flann.hpp>

#include "descriptors_of_frames.hpp"
#include "matching/descriptor_index.hpp"
#include "matching/descriptor_matcher.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kProbes = 32;
constexpr int kTrees = 4;
constexpr int kChecks = 1200;  // recall of about 95 % at 100,000
// LSH: the fastest at a recall of about 95 % with 100,000 of those tried, 12 to 30 tables, 16 to 28
// bits, 0 to 2 levels of probes (20, 24, 1: 0.48 ms a query at 91 %; 20, 22, 1: 0.67 ms at 95 %;
// 12, 24, 2: 2.0 ms at 97 %).
constexpr int kHashTables = 20;
constexpr int kHashBits = 22;
constexpr int kProbeLevels = 1;

cv::Mat asMat(const std::vector<Descriptor>& descriptors) {
  cv::Mat rows(static_cast<int>(descriptors.size()), sizeof(Descriptor), CV_8U);
  std::memcpy(rows.data, descriptors.data(), descriptors.size() * sizeof(Descriptor));
  return rows;
}

MatcherConfig takeAll() {
  MatcherConfig config;
  config.cross_check = false;
  config.max_hamming_bits = 512;
  config.ratio = 1;
  return config;
}

/// Distance of each query's true nearest neighbour.
const std::vector<int>& trueDistances(std::size_t size) {
  static std::map<std::size_t, std::vector<int>> known;
  std::vector<int>& distances = known[size];
  if (!distances.empty()) return distances;
  const MapDescriptors& data = mapDescriptors(size);
  std::vector<BestTwo> best;
  for (const Descriptor& query : data.query) {
    BestTwo nearest;
    for (std::size_t i = 0; i < data.map.size(); ++i)
      nearest.offer(static_cast<int>(i), hammingDistance(query, data.map[i]));
    distances.push_back(nearest.distance_bits);
  }
  return distances;
}

/// Share of the queries whose answer is as near as the true nearest neighbour.
template <class AnswerDistance>
double recall(std::size_t size, AnswerDistance distance) {
  const auto& expected = trueDistances(size);
  int found = 0;
  for (std::size_t q = 0; q < expected.size(); ++q) found += distance(q) == expected[q] ? 1 : 0;
  return static_cast<double>(found) / static_cast<double>(expected.size());
}

auto exact(std::size_t size) {
  return [=] {
    auto matches = std::make_shared<std::vector<DescriptorMatch>>();
    const MapDescriptors& data = mapDescriptors(size);
    return [=, &data](std::size_t) {
      matchExact(data.query, data.map, takeAll(), *matches);
      return data.query.size();
    };
  };
}

auto bruteForceOfOpenCv(std::size_t size) {
  return [=] {
    auto matches = std::make_shared<std::vector<std::vector<cv::DMatch>>>();
    const cv::Mat query = asMat(mapDescriptors(size).query);
    const cv::Mat map = asMat(mapDescriptors(size).map);
    return [=](std::size_t) {
      matches->clear();  // knnMatch appends
      cv::BFMatcher(cv::NORM_HAMMING).knnMatch(query, map, *matches, 2);
      return matches->size();
    };
  };
}

DescriptorIndex& indexOf(std::size_t size) {
  static std::map<std::size_t, DescriptorIndex> made;
  DescriptorIndex& index = made[size];
  if (index.size() > 0) return index;
  std::vector<IndexEntry> entries;
  for (const Descriptor& descriptor : mapDescriptors(size).map)
    entries.push_back({static_cast<int>(entries.size()), descriptor});
  index.insert(entries);
  return index;
}

auto indexed(std::size_t size) {
  return [=] {
    auto best = std::make_shared<std::vector<BestTwo>>();
    return [=](std::size_t) {
      indexOf(size).search(mapDescriptors(size).query, kProbes, *best);
      return best->size();
    };
  };
}

double recallOfIndex(std::size_t size) {
  std::vector<BestTwo> best;
  indexOf(size).search(mapDescriptors(size).query, kProbes, best);
  return recall(size, [&](std::size_t q) { return best[q].distance_bits; });
}

/// FLANN with one kind of index, its memory and its answers.
struct Flann {
  cv::Mat map, query, indices, distances;
  std::unique_ptr<cv::flann::Index> index;

  Flann(std::size_t size, const cv::flann::IndexParams& kind)
      : map(asMat(mapDescriptors(size).map)), query(asMat(mapDescriptors(size).query)) {
    index = std::make_unique<cv::flann::Index>(map, kind, cvflann::FLANN_DIST_HAMMING);
  }
  void search() {
    index->knnSearch(query, indices, distances, 2, cv::flann::SearchParams(kChecks));
  }
};

Flann& hierarchicalOf(std::size_t size) {
  static std::map<std::size_t, std::unique_ptr<Flann>> made;
  auto& flann = made[size];
  if (!flann) {
    flann = std::make_unique<Flann>(size, cv::flann::HierarchicalClusteringIndexParams(
                                              32, cvflann::FLANN_CENTERS_RANDOM, kTrees, 100));
  }
  return *flann;
}

Flann& lshOf(std::size_t size) {
  static std::map<std::size_t, std::unique_ptr<Flann>> made;
  auto& flann = made[size];
  if (!flann) {
    flann = std::make_unique<Flann>(
        size, cv::flann::LshIndexParams(kHashTables, kHashBits, kProbeLevels));
  }
  return *flann;
}

void flannSide(const std::string& row, const std::string& who, Flann& (*flann)(std::size_t),
               std::size_t size) {
  const auto setup = [=] {
    return [=](std::size_t) {
      flann(size).search();
      return static_cast<std::size_t>(flann(size).query.rows);
    };
  };
  side(row, who, setup, [=] {
    flann(size).search();
    return recall(
        size, [=](std::size_t q) { return flann(size).distances.at<int>(static_cast<int>(q), 0); });
  });
}

}  // namespace

void addMatchingRows() {
  for (const std::size_t size : {1'000, 10'000, 100'000}) {
    const std::string suffix = "_" + std::to_string(size / 1000) + "k";
    side("exact" + suffix, "ours", exact(size));
    side("exact" + suffix, "cv::BFMatcher", bruteForceOfOpenCv(size));
    side("index" + suffix, "ours", indexed(size), [=] { return recallOfIndex(size); });
    flannSide("index" + suffix, "FLANN hierarchical", hierarchicalOf, size);
  }
  side("index_lsh_100k", "ours", indexed(100'000), [] { return recallOfIndex(100'000); });
  flannSide("index_lsh_100k", "FLANN LSH", lshOf, 100'000);
}

}  // namespace ardrone_vslam::bench
