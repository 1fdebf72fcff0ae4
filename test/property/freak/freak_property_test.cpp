// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "freak/freak.hpp"
#include "matching/hamming.hpp"
#include "support/freak_oracle.hpp"
#include "support/generated_image.hpp"

namespace ardrone_vslam::test {
namespace {

struct Described {
  std::vector<int> kept;
  std::vector<Descriptor> descriptors;
  std::vector<float> angles_deg;
};

Described describe(const ImageView& image, const std::vector<FreakKeypoint>& keypoints,
                   bool oriented = true, std::optional<float> orientation_rad = std::nullopt) {
  Described result;
  FreakDescriber scalar(FreakConfig{oriented}, InstructionSet::kScalar);
  scalar.describe(image, keypoints, result.kept, result.descriptors, &result.angles_deg,
                  orientation_rad);
  for (const InstructionSet set : supportedInstructionSets()) {
    std::vector<int> kept;
    std::vector<Descriptor> descriptors;  // without angles: the orientation is found another way
    FreakDescriber(FreakConfig{oriented}, set)
        .describe(image, keypoints, kept, descriptors, nullptr, orientation_rad);
    EXPECT_EQ(kept, result.kept) << nameOf(set);
    EXPECT_EQ(descriptors, result.descriptors) << nameOf(set);
  }
  return result;
}

bool isDescribed(const TestImage& image, int x, int y, float size = 7.F) {
  return !describe(image.view(), {{x, y, size}}).kept.empty();
}

std::vector<FreakKeypoint> gridOfKeypoints(int width, int height, int step_x, int step_y) {
  std::vector<FreakKeypoint> keypoints;
  for (int y = 24; y < height - 23; y += step_y) {
    for (int x = 24; x < width - 23; x += step_x) keypoints.push_back({x, y});
  }
  return keypoints;
}

TEST(FreakProperty, EqualsItsDefinitionOnEveryCoordinateParity) {
  const TestImage image = generatedImage(150, 131, 7);
  const auto keypoints = gridOfKeypoints(150, 131, 3, 5);
  const Described oriented = describe(image.view(), keypoints, true);
  const Described upright = describe(image.view(), keypoints, false);
  ASSERT_EQ(oriented.kept.size(), keypoints.size());
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    const FreakOracle oracle(image.view(), keypoints[k].x_px, keypoints[k].y_px);
    ASSERT_EQ(oriented.descriptors[k], oracle.oriented())
        << keypoints[k].x_px << ", " << keypoints[k].y_px;
    ASSERT_EQ(upright.descriptors[k], oracle.upright())
        << keypoints[k].x_px << ", " << keypoints[k].y_px;
    ASSERT_EQ(upright.angles_deg[k], 0.F);
  }
}

// At a few coordinates a box differs from the table's.
TEST(FreakProperty, EqualsItsDefinitionAtEveryColumnAndEveryRow) {
  const TestImage wide = generatedImage(1100, 52, 5);
  const TestImage tall = generatedImage(52, 1100, 6);
  std::vector<FreakKeypoint> columns;
  std::vector<FreakKeypoint> rows;
  for (int c = 24; c < 1100 - 23; ++c) {
    columns.push_back({c, 24 + c % 4});
    rows.push_back({24 + c % 4, c});
  }
  const auto in_wide = describe(wide.view(), columns).descriptors;
  const auto in_tall = describe(tall.view(), rows).descriptors;
  ASSERT_EQ(in_wide.size(), columns.size());
  ASSERT_EQ(in_tall.size(), rows.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const int c = columns[k].x_px;
    ASSERT_EQ(in_wide[k], FreakOracle(wide.view(), c, columns[k].y_px).oriented()) << c;
    ASSERT_EQ(in_tall[k], FreakOracle(tall.view(), rows[k].x_px, c).oriented()) << c;
  }
}

// Beyond 4096 px the table of boxes is not used; at the largest coordinates floats round borders
// most coarsely.
TEST(FreakProperty, EqualsItsDefinitionInVeryWideAndVeryTallImages) {
  for (const auto& [width, height] :
       {std::make_pair(4096, 60), {4097, 60}, {9001, 60}, {60, 4096}, {60, 7000}}) {
    const TestImage image = generatedImage(width, height, 11);
    const auto keypoints = gridOfKeypoints(width, height, 13, 13);
    const Described described = describe(image.view(), keypoints);
    ASSERT_EQ(described.kept.size(), keypoints.size());
    for (std::size_t k = 0; k < keypoints.size(); ++k) {
      const FreakOracle oracle(image.view(), keypoints[k].x_px, keypoints[k].y_px);
      ASSERT_EQ(described.descriptors[k], oracle.oriented())
          << keypoints[k].x_px << ", " << keypoints[k].y_px;
    }
  }
}

TEST(FreakProperty, SaturatedImageDoesNotOverflowTheIntegralImage) {
  TestImage image(300, 300);
  for (std::size_t k = 0; k < image.bytes.size(); ++k) image.bytes[k] = k % 97 == 0 ? 250 : 255;
  const auto keypoints = gridOfKeypoints(300, 300, 17, 19);
  const Described described = describe(image.view(), keypoints);
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    const FreakOracle oracle(image.view(), keypoints[k].x_px, keypoints[k].y_px);
    ASSERT_EQ(described.descriptors[k], oracle.oriented());
  }
}

TEST(FreakProperty, FlatPatchSetsAllBitsAndHasNoAngle) {
  const TestImage image(90, 90);
  const Described described = describe(image.view(), {{45, 45}, {45, 45, 9.F}});
  ASSERT_EQ(described.kept.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(described.angles_deg[k], 0.F);
    for (const auto word : described.descriptors[k].words) EXPECT_EQ(word, ~std::uint64_t{0});
  }
}

TEST(FreakProperty, BorderRuleAtEveryEdge) {
  const TestImage image = generatedImage(101, 83);
  EXPECT_FALSE(isDescribed(image, 23, 40));
  EXPECT_TRUE(isDescribed(image, 24, 40));
  EXPECT_TRUE(isDescribed(image, 101 - 24, 40));
  EXPECT_FALSE(isDescribed(image, 101 - 23, 40));
  EXPECT_FALSE(isDescribed(image, 50, 23));
  EXPECT_TRUE(isDescribed(image, 50, 24));
  EXPECT_TRUE(isDescribed(image, 50, 83 - 24));
  EXPECT_FALSE(isDescribed(image, 50, 83 - 23));
  for (const int outside : {-1000000, -1, 1000000}) {
    EXPECT_FALSE(isDescribed(image, outside, 40));
    EXPECT_FALSE(isDescribed(image, 50, outside));
  }
}

TEST(FreakProperty, SmallestImageHasOneKeypointAndSmallerOnesHaveNone) {
  const TestImage smallest = generatedImage(48, 48);
  const Described described = describe(smallest.view(), gridOfKeypoints(60, 60, 1, 1));
  ASSERT_EQ(described.kept.size(), 1U);
  EXPECT_EQ(described.descriptors[0], FreakOracle(smallest.view(), 24, 24).oriented());
  EXPECT_TRUE(describe(generatedImage(47, 48).view(), gridOfKeypoints(60, 60, 1, 1)).kept.empty());
  EXPECT_TRUE(describe(generatedImage(48, 47).view(), gridOfKeypoints(60, 60, 1, 1)).kept.empty());
  EXPECT_TRUE(describe(ImageView{}, gridOfKeypoints(60, 60, 1, 1)).kept.empty());
}

// At scale k the pattern reaches 22 * 2^(k / 16) px from the keypoint.
TEST(FreakProperty, LargerKeypointsNeedAWiderBorder) {
  const TestImage image = generatedImage(801, 801);
  for (const float size : {10.F, 14.F, 24.F, 50.F, 1e9F}) {
    const double step =
        std::min(63.0, std::floor(16.0 * std::log2(static_cast<double>(size) / 7.0) + 0.5));
    const int border = static_cast<int>(std::ceil(22.0 * std::exp2(step / 16.0) - 1e-9)) + 1;
    EXPECT_FALSE(isDescribed(image, border, 400, size)) << size;
    EXPECT_TRUE(isDescribed(image, border + 1, 400, size)) << size;
    EXPECT_TRUE(isDescribed(image, 400, 801 - border - 1, size)) << size;
    EXPECT_FALSE(isDescribed(image, 400, 801 - border, size)) << size;
  }
}

TEST(FreakProperty, SizesOfAtMostSevenAndNotANumberAreThePatternsOwn) {
  const TestImage image = generatedImage(80, 80);
  const auto reference = describe(image.view(), {{40, 40, 7.F}}).descriptors;
  for (const float size : {-3.F, 0.F, 1.F, 7.1F, std::nanf("")}) {
    EXPECT_EQ(describe(image.view(), {{40, 40, size}}).descriptors, reference) << size;
  }
}

TEST(FreakProperty, StrideAndPaddingDoNotMatter) {
  const TestImage image = generatedImage(97, 90);
  const auto keypoints = gridOfKeypoints(97, 90, 7, 5);
  const Described reference = describe(image.view(), keypoints);
  for (const std::ptrdiff_t stride : {98, 101, 128, 1000}) {
    TestImage padded(97, 90, stride);
    std::fill(padded.bytes.begin(), padded.bytes.end(), std::uint8_t{255});
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 97; ++x) padded.at(x, y) = image.at(x, y);
    }
    const Described described = describe(padded.view(), keypoints);
    EXPECT_EQ(described.descriptors, reference.descriptors) << stride;
    EXPECT_EQ(described.angles_deg, reference.angles_deg) << stride;
  }
}

TEST(FreakProperty, KeptNamesTheDescribedKeypointsInTheOrderGiven) {
  const TestImage image = generatedImage(200, 200);
  const std::vector<FreakKeypoint> keypoints{{150, 60},       {5, 100},   {60, 150},
                                             {60, 150, 10.F}, {100, 199}, {60, 150}};
  const Described described = describe(image.view(), keypoints);
  ASSERT_EQ(described.kept, (std::vector<int>{0, 2, 3, 5}));
  ASSERT_EQ(described.descriptors.size(), 4U);
  ASSERT_EQ(described.angles_deg.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto index = static_cast<std::size_t>(described.kept[k]);
    const Described alone = describe(image.view(), {keypoints[index]});
    EXPECT_EQ(described.descriptors[k], alone.descriptors[0]) << k;
    EXPECT_EQ(described.angles_deg[k], alone.angles_deg[0]) << k;
  }
  EXPECT_EQ(described.descriptors[1], described.descriptors[3]);
  EXPECT_NE(described.descriptors[1], described.descriptors[2])
      << "another size is another pattern";
}

TEST(FreakProperty, AnObjectRemembersNothingOfEarlierFrames) {
  FreakDescriber describer(FreakConfig{});
  std::vector<int> kept{1, 2, 3};
  std::vector<Descriptor> descriptors(7);
  std::vector<float> angles_deg(9);
  for (const int size : {160, 90, 47, 200}) {
    const TestImage image = generatedImage(size, size + 3, static_cast<std::uint32_t>(size));
    const std::vector<FreakKeypoint> keypoints{{40, 40}, {45, 50, 8.F}, {60, 60, 12.F}};
    describer.describe(image.view(), keypoints, kept, descriptors, &angles_deg);
    const Described fresh = describe(image.view(), keypoints);
    EXPECT_EQ(kept, fresh.kept);
    EXPECT_EQ(descriptors, fresh.descriptors);
    EXPECT_EQ(angles_deg, fresh.angles_deg);
  }
}

/// Turns the image clockwise by 90 degrees: (x, y) goes to (height - 1 - y, x).
TestImage turned(const TestImage& image) {
  TestImage result(image.height_px, image.width_px);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) result.at(image.height_px - 1 - y, x) = image.at(x, y);
  }
  return result;
}

struct RotationResult {
  double share_turned_alike, oriented_bits, upright_bits;  ///< means over all keypoints
};

/// Turns image and keypoints by quarter turns and compares angles and descriptors with those
/// before.
RotationResult rotateImage(int quarter_turns, double tolerance_deg) {
  TestImage image = generatedImage(180, 150, 3);
  auto keypoints = gridOfKeypoints(180, 150, 5, 7);
  const Described before = describe(image.view(), keypoints, true);
  const Described upright_before = describe(image.view(), keypoints, false);
  for (int turn = 0; turn < quarter_turns; ++turn) {
    for (auto& k : keypoints) k = {image.height_px - 1 - k.y_px, k.x_px};
    image = turned(image);
  }
  const Described after = describe(image.view(), keypoints, true);
  const Described upright_after = describe(image.view(), keypoints, false);
  RotationResult result{};
  const auto count = static_cast<double>(keypoints.size());
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    const double rotation_deg = after.angles_deg[k] - before.angles_deg[k] - 90.0 * quarter_turns;
    if (std::abs(std::remainder(rotation_deg, 360.0)) < tolerance_deg)
      result.share_turned_alike += 1 / count;
    const auto distance = [k](const Described& a, const Described& b) {
      return hammingDistance(a.descriptors[k], b.descriptors[k]);
    };
    result.oriented_bits += distance(before, after) / count;
    result.upright_bits += distance(upright_before, upright_after) / count;
  }
  return result;
}

// The rings are hexagons, so a quarter turn gives other votes: the angle is only about the same, as
// are the descriptors. An upright descriptor must change as if the patches were strangers.
TEST(FreakProperty, QuarterTurnTurnsTheAngleAndKeepsTheOrientedDescriptor) {
  for (const int quarter_turns : {1, 3}) {
    const RotationResult result = rotateImage(quarter_turns, 10.0);
    EXPECT_GT(result.share_turned_alike, 0.75);
    EXPECT_LT(result.oriented_bits, 60.0);
    EXPECT_GT(result.upright_bits, 180.0);
  }
}

// A half turn maps the pattern on itself but for the rounding of borders.
TEST(FreakProperty, HalfTurnTurnsTheAngleAndHardlyTouchesTheOrientedDescriptor) {
  const RotationResult result = rotateImage(2, 3.0);
  EXPECT_GT(result.share_turned_alike, 0.98);
  EXPECT_LT(result.oriented_bits, 5.0);
  EXPECT_GT(result.upright_bits, 180.0);
}

/// A smooth scene as it appears turned clockwise by `angle_rad` about the image's centre.
TestImage rotatedScene(double angle_rad) {
  TestImage image(241, 241);
  for (int y = 0; y < 241; ++y) {
    for (int x = 0; x < 241; ++x) {
      const double u = std::cos(angle_rad) * (x - 120) + std::sin(angle_rad) * (y - 120);
      const double v = std::cos(angle_rad) * (y - 120) - std::sin(angle_rad) * (x - 120);
      const double waves = std::sin(0.31 * u + 0.13 * v) + std::sin(0.23 * v - 0.17 * u + 1.0) +
                           std::sin(0.011 * u * v) + std::sin(0.05 * u + 0.41 * v + 2.0);
      image.at(x, y) = static_cast<std::uint8_t>(std::lround(127.0 + 31.0 * waves));
    }
  }
  return image;
}

/// Where the points of a grid about the centre appear when the scene is turned so.
std::vector<FreakKeypoint> rotatedGrid(double angle_rad) {
  std::vector<FreakKeypoint> keypoints;
  for (int v = -48; v <= 48; v += 8) {
    for (int u = -48; u <= 48; u += 8) {
      keypoints.push_back(
          {120 + static_cast<int>(std::lround(std::cos(angle_rad) * u - std::sin(angle_rad) * v)),
           120 + static_cast<int>(std::lround(std::sin(angle_rad) * u + std::cos(angle_rad) * v))});
    }
  }
  return keypoints;
}

double meanDistance_bits(const Described& a, const Described& b) {
  double bits = 0.0;
  for (std::size_t k = 0; k < a.descriptors.size(); ++k)
    bits += hammingDistance(a.descriptors[k], b.descriptors[k]);
  return bits / static_cast<double>(a.descriptors.size());
}

TEST(FreakProperty, KnownOrientationUndoesATurnOfTheScene) {
  const Described level = describe(rotatedScene(0.0).view(), rotatedGrid(0.0), false);
  for (const double angle_rad : {0.4, -0.9, 1.7, 3.0, -2.5}) {
    const TestImage image = rotatedScene(angle_rad);
    const auto keypoints = rotatedGrid(angle_rad);
    const auto known = describe(image.view(), keypoints, false, static_cast<float>(angle_rad));
    const auto unturned = describe(image.view(), keypoints, false);
    const auto wrong = describe(image.view(), keypoints, false, static_cast<float>(-angle_rad));
    ASSERT_EQ(known.descriptors.size(), level.descriptors.size());
    EXPECT_LT(meanDistance_bits(level, known), 40.0) << angle_rad;
    EXPECT_GT(meanDistance_bits(level, unturned), 80.0) << angle_rad;
    if (std::abs(angle_rad) < 2.9) {  // minus half a turn is half a turn
      EXPECT_GT(meanDistance_bits(level, wrong), 80.0) << angle_rad;
    }
  }
}

TEST(FreakProperty, KnownOrientationReplacesTheEstimateAndIsRoundedToTheNearest) {
  constexpr double kRotation_rad = 2.0 * 3.14159265358979323846;
  const TestImage image = generatedImage(120, 110);
  const auto keypoints = gridOfKeypoints(120, 110, 9, 7);
  const auto at = [&](double orientation, bool oriented) {
    return describe(image.view(), keypoints, oriented,
                    static_cast<float>(orientation * kRotation_rad / 256.0));
  };
  const Described third = at(3.0, true);
  EXPECT_EQ(at(3.0, false).descriptors, third.descriptors);
  EXPECT_EQ(at(2.6, true).descriptors, third.descriptors);
  EXPECT_EQ(at(3.4 - 256.0, true).descriptors, third.descriptors);
  EXPECT_NE(at(4.0, true).descriptors, third.descriptors);
  EXPECT_EQ(at(0.0, true).descriptors, describe(image.view(), keypoints, false).descriptors);
  for (const float angle_deg : third.angles_deg)
    EXPECT_NEAR(angle_deg, 3.0F * 360.F / 256.F, 1e-4F);
}

}  // namespace
}  // namespace ardrone_vslam::test
