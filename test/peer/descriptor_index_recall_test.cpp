// SPDX-License-Identifier: BSD-3-Clause
// Recall on real images; OpenCV only reads the image files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "association/associator.hpp"
#include "corners/corner_detector.hpp"
#include "freak/freak.hpp"
#include "matching/descriptor_index.hpp"
#include "matching/hamming.hpp"
#include "support/real_data.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr int kEntries = 100'000;

/// Descriptors of the corners of one image after the other, with the default configuration.
class DescribedSequence {
 public:
  explicit DescribedSequence(const std::string& folder) : folder_(folder) {}

  std::vector<Descriptor> describe(int frame) {
    char name[32];
    std::snprintf(name, sizeof(name), "/image_0/%06d.png", frame);
    const cv::Mat pixels = cv::imread(folder_ + name, cv::IMREAD_GRAYSCALE);
    if (pixels.empty()) return {};
    const ImageView image{pixels.data, pixels.cols, pixels.rows,
                          static_cast<std::ptrdiff_t>(pixels.step)};
    detector_.detect(image, corners_);
    std::vector<FreakKeypoint> keypoints;
    for (const Corner& corner : corners_) keypoints.push_back({corner.x_px, corner.y_px});
    std::vector<Descriptor> descriptors;
    describer_.describe(image, keypoints, kept_, descriptors);
    return descriptors;
  }

 private:
  std::string folder_;
  CornerDetector detector_{CornerDetectorConfig{}};
  FreakDescriber describer_{FreakConfig{}};
  std::vector<Corner> corners_;
  std::vector<int> kept_;
};

TEST(DescriptorIndexRecall, FindsTheExactNeighbourOf97PercentAmong100000RealDescriptors) {
  if (realData().empty())
    GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set: the recall on real images is not measured";
  // Even frames are the entries; of the odd ones, which are held out, every tenth is asked for.
  DescribedSequence sequence(realData() + "/kitti_03");
  std::vector<IndexEntry> entries;
  std::vector<Descriptor> queries;
  for (int frame = 0; entries.size() < kEntries; ++frame) {
    const auto descriptors = sequence.describe(frame);
    ASSERT_FALSE(descriptors.empty()) << "kitti_03 ends at frame " << frame;
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      if (frame % 2 == 0 && entries.size() < kEntries)
        entries.push_back({static_cast<int>(entries.size()), descriptors[i]});
      if (frame % 20 == 9 && i % 4 == 0) queries.push_back(descriptors[i]);
    }
  }
  DescriptorIndex index;
  index.insert(entries);
  std::vector<BestTwo> found;
  index.search(queries, AssociationConfig{}.index_probes, found);
  int hits = 0;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    int nearest_bits = kNoDistance_bits;
    for (const IndexEntry& entry : entries)
      nearest_bits = std::min(nearest_bits, hammingDistance(queries[q], entry.descriptor));
    hits += found[q].distance_bits == nearest_bits ? 1 : 0;
  }
  const double recall = static_cast<double>(hits) / static_cast<double>(queries.size());
  RecordProperty("recall", std::to_string(recall));
  EXPECT_GE(queries.size(), 1000U);
  EXPECT_GE(recall, 0.97);
}

}  // namespace
}  // namespace ardrone_vslam::test
