// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "corners/corner_detector.hpp"
#include "corners/corner_thresholds.hpp"
#include "corners/sampling_raster.hpp"
#include "support/fast_oracle.hpp"
#include "support/fast_scan.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr int kThreshold = 20;

CornerDetectorConfig unlimited(int arc, int passes, Suppression suppression) {
  CornerDetectorConfig config;
  config.arc_length_px = arc;
  config.threshold = kThreshold;
  config.sampling_passes = passes;
  config.suppression = suppression;
  config.features_per_frame = 20000;
  config.adapt_threshold = false;
  return config;
}

/// The corners that all instruction sets find.
std::vector<Corner> detect(const CornerDetectorConfig& config, const GreyImage& image) {
  std::vector<Corner> corners;
  CornerDetector(config, InstructionSet::kScalar).detect(image.view(), corners);
  for (const InstructionSet set : supportedInstructionSets()) {
    std::vector<Corner> others;
    CornerDetector(config, set).detect(image.view(), others);
    expectSameCorners(others, corners, set);
  }
  return corners;
}

Positions positions(const std::vector<Corner>& corners) {
  Positions result;
  for (const Corner& c : corners) result.insert({c.y_px, c.x_px});
  return result;
}

/// The same places, each once, in raster order, with their scores.
void expectEqual(const std::vector<Corner>& corners, const Positions& expected,
                 const ScoreOracle& scores) {
  ASSERT_EQ(corners.size(), expected.size());
  std::size_t i = 0;
  for (const Position& p : expected) {
    ASSERT_EQ(corners[i].x_px, p.x_px);
    ASSERT_EQ(corners[i].y_px, p.y_px);
    ASSERT_EQ(corners[i].score, scores.at(p));
    ++i;
  }
}

/// Thesis figure 3.10 written out once more, as the picture of the block: the pass that tests each
/// pixel.
constexpr int kPassOfPixel[4][4] = {{1, 9, 3, 11}, {13, 5, 15, 7}, {4, 12, 2, 10}, {16, 8, 14, 6}};

Positions sampled(const Positions& corners, int passes) {
  Positions result;
  for (const Position& p : corners) {
    if (kPassOfPixel[p.y_px % 4][p.x_px % 4] <= passes) result.insert(p);
  }
  return result;
}

class Suppressions : public testing::TestWithParam<int> {};  // arc length

TEST_P(Suppressions, EqualTheirDefinitionForEveryNumberOfPasses) {
  std::size_t corners = 0;
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const GreyImage& image : variedImages(seed)) {
      const ScoreOracle scores(image, GetParam());
      corners += scores.corners(kThreshold).size();
      for (int passes = 1; passes <= 16; ++passes) {
        SCOPED_TRACE("passes " + std::to_string(passes));
        const Positions hits = sampled(scores.corners(kThreshold), passes);
        expectEqual(detect(unlimited(GetParam(), passes, Suppression::kLocalClimb), image),
                    scores.climb(hits), scores);
        expectEqual(detect(unlimited(GetParam(), passes, Suppression::kStrict3x3), image),
                    scores.strictMaxima(hits), scores);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(corners, 1000U) << "the images have too few corners for this test to mean anything";
}

TEST_P(Suppressions, AllPassesGiveExactlyThePixelsHigherThanTheirNeighbours) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const GreyImage& image : variedImages(seed)) {
      const ScoreOracle scores(image, GetParam());
      Positions highest;
      for (const Position& p : scores.corners(kThreshold)) {
        if (scores.climb(p) == p) highest.insert(p);
      }
      EXPECT_EQ(positions(detect(unlimited(GetParam(), 16, Suppression::kLocalClimb), image)),
                highest);
    }
  }
}

TEST_P(Suppressions, EachPassFindsAllThatFewerFind) {
  std::mt19937 random(7);
  GreyImage image(161, 123, 5);
  fillDots(image, {9, 120, 6, 127}, random, 0, image.width());
  Positions fewer;
  std::vector<std::size_t> counts;
  for (int passes = 1; passes <= 16; ++passes) {
    const Positions more =
        positions(detect(unlimited(GetParam(), passes, Suppression::kLocalClimb), image));
    EXPECT_TRUE(std::includes(more.begin(), more.end(), fewer.begin(), fewer.end())) << passes;
    fewer = more;
    counts.push_back(more.size());
  }
  EXPECT_LT(counts.front(), counts[7]);
  EXPECT_LT(counts[7], counts.back());
}

TEST_P(Suppressions, FourPassesFindTheMaximumOfEvery2x2Block) {
  int blocks = 0;
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const GreyImage& image : variedImages(seed)) {
      const ScoreOracle scores(image, GetParam());
      const Positions corners = scores.corners(kThreshold);
      const Positions found =
          positions(detect(unlimited(GetParam(), 4, Suppression::kLocalClimb), image));
      for (const Position& p : corners) {
        const Position block[4] = {
            p, {p.y_px, p.x_px + 1}, {p.y_px + 1, p.x_px}, {p.y_px + 1, p.x_px + 1}};
        bool whole = true;
        bool any_found = false;
        for (const Position& q : block) {
          whole = whole && corners.count(q) != 0;
          any_found = any_found || (corners.count(q) != 0 && found.count(scores.climb(q)) != 0);
        }
        if (!whole) continue;
        ++blocks;
        EXPECT_TRUE(any_found) << p.x_px << ", " << p.y_px;
      }
    }
  }
  EXPECT_GT(blocks, 100)
      << "the images have too few blocks of corners for this test to mean anything";
}

/// What a detector with a threshold for each cell must find, frame by frame.
class ThresholdOracle {
 public:
  ThresholdOracle(const CornerDetectorConfig& config, const GreyImage& image) : config_(config) {
    cells_.reset(image.width(), image.height(), config.cell_size_px);
    thresholds_.reset(config, cells_.count());
  }

  std::vector<Corner> next(const ScoreOracle& scores) {
    const auto reaches = [&](const Position& p) {
      return scores.at(p) >= thresholds_.at(cells_.cellAt(p.x_px, p.y_px));
    };
    Positions hits;
    for (const Position& p : sampled(scores.corners(1), config_.sampling_passes))
      if (reaches(p)) hits.insert(p);
    std::vector<Corner> all;
    for (const Position& p : scores.climb(hits)) {
      if (!reaches(p)) continue;
      all.push_back({static_cast<std::int16_t>(p.x_px), static_cast<std::int16_t>(p.y_px),
                     static_cast<std::uint8_t>(scores.at(p))});
    }
    std::vector<Corner> expected;
    CornersByCell by_cell;
    by_cell.group(all, cells_);
    by_cell.select(config_.features_per_frame, expected);
    thresholds_.adapt(by_cell);
    return expected;
  }

  /// Neighbouring cells with different thresholds.
  int differences() const {
    int different = 0;
    for (int cell = 1; cell < cells_.count(); ++cell)
      different += thresholds_.at(cell) != thresholds_.at(cell - 1);
    return different;
  }

 private:
  CornerDetectorConfig config_;
  CornerCells cells_;
  CornerThresholds thresholds_;
};

/// Thresholds that differ from cell to cell: the definition holds with each pixel's own threshold,
/// also where clusters lie across the border of two cells.
TEST_P(Suppressions, HoldWithTheThresholdOfEachCell) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    GreyImage image(81, 48, 3);
    std::vector<ThresholdOracle> oracles;
    std::vector<std::unique_ptr<CornerDetector>> detectors;  // of each oracle's, one for each set
    for (const int passes : {1, 3, 8, 15, 16}) {
      CornerDetectorConfig config = unlimited(GetParam(), passes, Suppression::kLocalClimb);
      config.adapt_threshold = true;
      config.features_per_frame = 40;
      config.cell_size_px = 16;
      oracles.emplace_back(config, image);
      for (const InstructionSet set : supportedInstructionSets())
        detectors.push_back(std::make_unique<CornerDetector>(config, set));
    }
    int different = 0;
    for (int frame = 0; frame < 6; ++frame) {
      fillBlocks(image, {2, 256, 255, 20}, random, 0, 40);
      fillBlocks(image, {2, 256, 120, 5}, random, 40, image.width());
      const ScoreOracle scores(image, GetParam());
      auto detector = detectors.begin();
      for (ThresholdOracle& oracle : oracles) {
        const std::vector<Corner> expected = oracle.next(scores);
        for (const InstructionSet set : supportedInstructionSets()) {
          std::vector<Corner> corners;
          (*detector++)->detect(image.view(), corners);
          expectSameCorners(corners, expected, set);
        }
        different += oracle.differences();
      }
    }
    EXPECT_GT(different, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Arcs, Suppressions, testing::Values(9, 10, 11, 12),
                         testing::PrintToStringParamName());

TEST(SamplingRaster, TestsEachPixelOfABlockOnce) {
  for (int y = 0; y < 8; ++y) {
    for (int passes = 1; passes <= 16; ++passes) {
      for (int x = 0; x < 4; ++x) {
        const bool tested = ((sampledColumns(y, passes) >> x) & 1U) != 0;
        EXPECT_EQ(tested, kPassOfPixel[y % 4][x] <= passes)
            << x << ", " << y << " passes " << passes;
      }
    }
  }
}

TEST(SamplingRaster, EightPassesMakeACheckerboard) {
  for (int y = 0; y < 4; ++y) EXPECT_EQ(sampledColumns(y, 8), y % 2 == 0 ? 0x5U : 0xAU);
}

}  // namespace
}  // namespace ardrone_vslam::test
