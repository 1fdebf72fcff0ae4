// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kStamp_ns = 1'234'567'890'123'456'789;

ImageFeatures randomFeatures(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> number(-1.F, 1.F);
  ImageFeatures features;
  features.stamp_ns = kStamp_ns;
  features.width_px = 640;
  features.height_px = 360;
  features.focal_length_px = 570.25F;
  for (std::size_t i = 0; i < count; ++i) {
    features.pixel_px.emplace_back(320 + 300 * number(random), 180 + 170 * number(random));
    features.bearing_cam.push_back(
        Eigen::Vector3f(number(random), number(random), 1.F).normalized());
    features.score.push_back(static_cast<std::uint8_t>(random()));
    features.track_id.push_back(static_cast<std::uint32_t>(i + 1));
    features.age_frames.push_back(static_cast<std::uint16_t>(random()));
    Descriptor descriptor;
    for (auto& word : descriptor.words) word = random();
    features.descriptor.push_back(descriptor);
    const float xy = number(random);
    features.information.push_back({2, xy, 3});
    if (i % 3 == 0) features.information.back() = {};
    features.residual.push_back(2 + number(random));
  }
  return features;
}

void expectEqual(const ImageFeatures& a, const ImageFeatures& b) {
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_EQ(a.focal_length_px, b.focal_length_px);
  EXPECT_EQ(a.pixel_px, b.pixel_px);
  EXPECT_EQ(a.bearing_cam, b.bearing_cam);
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.track_id, b.track_id);
  EXPECT_EQ(a.age_frames, b.age_frames);
  EXPECT_EQ(a.descriptor, b.descriptor);
  EXPECT_EQ(a.residual, b.residual);
  ASSERT_EQ(a.information.size(), b.information.size());
  for (std::size_t i = 0; i < a.information.size(); ++i) {
    EXPECT_EQ(a.information[i].xx_per_px2, b.information[i].xx_per_px2);
    EXPECT_EQ(a.information[i].xy_per_px2, b.information[i].xy_per_px2);
    EXPECT_EQ(a.information[i].yy_per_px2, b.information[i].yy_per_px2);
  }
}

TEST(FeaturesConversion, RoundTripIsExact) {
  for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
    const ImageFeatures sent = randomFeatures(count, 7 + count);
    Features message;
    toMessage(sent, "camera_optical", message);
    EXPECT_EQ(faultOf(message), "");
    EXPECT_EQ(message.header.frame_id, "camera_optical");
    ImageFeatures received = randomFeatures(3, 1);  // what was there before must go
    toFeatures(message, received);
    expectEqual(sent, received);
  }
}

TEST(FeaturesConversion, MessageMayBeUsedAgain) {
  Features message;
  toMessage(randomFeatures(50, 1), "camera_optical", message);
  const ImageFeatures fewer = randomFeatures(20, 2);
  toMessage(fewer, "camera_optical", message);
  ImageFeatures received;
  toFeatures(message, received);
  expectEqual(fewer, received);
}

struct Spoiled {
  const char* expected;  // part of the sentence
  std::function<void(Features&)> spoil;
};

class FeaturesFault : public testing::TestWithParam<Spoiled> {};

TEST_P(FeaturesFault, IsNamed) {
  Features message;
  toMessage(randomFeatures(10, 3), "camera_optical", message);
  ASSERT_EQ(faultOf(message), "");
  GetParam().spoil(message);
  EXPECT_NE(faultOf(message).find(GetParam().expected), std::string::npos) << faultOf(message);
}

constexpr float kFloatNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

INSTANTIATE_TEST_SUITE_P(
    All, FeaturesFault,
    testing::Values(
        Spoiled{"stamp is zero", [](Features& m) { m.header.stamp = ros::Time(); }},
        Spoiled{"no frame_id", [](Features& m) { m.header.frame_id.clear(); }},
        Spoiled{"image size", [](Features& m) { m.width = 0; }},
        Spoiled{"focal_length", [](Features& m) { m.focal_length = 0; }},
        Spoiled{"focal_length", [](Features& m) { m.focal_length = kFloatNaN; }},
        Spoiled{"50 times the image width", [](Features& m) { m.focal_length = 1e30F; }},
        Spoiled{"'y' has 9", [](Features& m) { m.y.pop_back(); }},
        Spoiled{"'score' has 11", [](Features& m) { m.score.push_back(1); }},
        Spoiled{"'track_id' has 0", [](Features& m) { m.track_id.clear(); }},
        Spoiled{"'age' has 9", [](Features& m) { m.age.pop_back(); }},
        Spoiled{"'bearing' has 29", [](Features& m) { m.bearing.pop_back(); }},
        Spoiled{"'descriptor' has 639", [](Features& m) { m.descriptor.pop_back(); }},
        Spoiled{"'information' has 29", [](Features& m) { m.information.pop_back(); }},
        Spoiled{"'residual' has 9", [](Features& m) { m.residual.pop_back(); }},
        Spoiled{"'residual' has 10 entries", [](Features& m) { m.information.clear(); }},
        Spoiled{"information 1", [](Features& m) { m.information[4] = kFloatNaN; }},
        Spoiled{"information 2", [](Features& m) { m.information[7] = -3; }},
        Spoiled{"'y' has 10 entries where 'x' asks for 0", [](Features& m) { m.x.clear(); }},
        Spoiled{"not finite", [](Features& m) { m.x[4] = kInf; }},
        Spoiled{"bearing 2", [](Features& m) { m.bearing[7] = kFloatNaN; }},
        Spoiled{"bearing 0", [](Features& m) { m.bearing[2] = 2; }},
        Spoiled{"track_id 3", [](Features& m) { m.track_id[3] = 0; }}));

}  // namespace
}  // namespace ardrone_vslam
