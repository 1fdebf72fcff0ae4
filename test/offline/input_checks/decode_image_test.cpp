// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks/decode_image.hpp"

#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const std::string& extension, const std::vector<int>& settings = {}) {
  Bytes bytes;
  cv::imencode(extension, testImage(1, 64, 48), bytes, settings);
  return bytes;
}

Bytes cut(Bytes bytes, std::size_t size) {
  bytes.resize(size);
  return bytes;
}

TEST(DecodeImage, WholeImages) {
  for (const Bytes& bytes :
       {encoded(".png"), encoded(".jpg"), encoded(".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
        encoded(".jpg", {cv::IMWRITE_JPEG_RST_INTERVAL, 1}), encoded(".pgm")}) {
    EXPECT_FALSE(isCutOff(bytes));
    EXPECT_EQ(decodeGrey(bytes).size(), cv::Size(64, 48));
  }
}

TEST(DecodeImage, WhatIsCutOffAnywhereIsNoImage) {
  for (const Bytes& bytes :
       {encoded(".png"), encoded(".jpg"), encoded(".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
        encoded(".jpg", {cv::IMWRITE_JPEG_RST_INTERVAL, 1})}) {
    for (std::size_t size = 8; size < bytes.size(); ++size) {
      ASSERT_TRUE(isCutOff(cut(bytes, size))) << size << " of " << bytes.size();
    }
    EXPECT_TRUE(decodeGrey(cut(bytes, bytes.size() / 2)).empty());
    EXPECT_TRUE(decodeGrey(cut(bytes, 0)).empty());
  }
}

TEST(DecodeImage, DamageWithinAPngIsFoundBeforeLibpngPrintsIt) {
  const Bytes whole = encoded(".png");
  testing::internal::CaptureStderr();
  for (std::size_t at = 8; at < whole.size(); ++at) {
    Bytes damaged = whole;
    damaged[at] ^= 0x5a;
    EXPECT_TRUE(decodeGrey(damaged).empty()) << at << " of " << whole.size();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(DecodeImage, DamageInWhatIsNoPixelDoesNoHarm) {
  Bytes bytes = encoded(".png");
  const cv::Mat image = decodeGrey(bytes);
  // A comment with a wrong sum, behind the header, which has 13 bytes.
  const Bytes comment{0, 0, 0, 3, 't', 'E', 'X', 't', 'a', 0, 'b', 1, 2, 3, 4};
  bytes.insert(bytes.begin() + 8 + 12 + 13, comment.begin(), comment.end());
  EXPECT_EQ(cv::norm(decodeGrey(bytes), image, cv::NORM_INF), 0);
}

TEST(DecodeImage, PaddingDoesNoHarm) {
  for (const std::string extension : {".png", ".jpg"}) {
    Bytes bytes = encoded(extension);
    const cv::Mat image = decodeGrey(bytes);
    bytes.resize(bytes.size() + 4096);
    EXPECT_EQ(cv::norm(decodeGrey(bytes), image, cv::NORM_INF), 0) << extension;
  }
}

TEST(DecodeImage, ThePreviewsEndIsNotTheImages) {
  const Bytes preview = encoded(".jpg");
  Bytes bytes = encoded(".jpg");
  const std::size_t length = preview.size() + 2;
  Bytes segment{0xff, 0xe1, static_cast<std::uint8_t>(length >> 8),
                static_cast<std::uint8_t>(length & 0xff)};
  segment.insert(segment.end(), preview.begin(), preview.end());
  bytes.insert(bytes.begin() + 2, segment.begin(), segment.end());
  EXPECT_FALSE(isCutOff(bytes));
  EXPECT_TRUE(isCutOff(cut(bytes, bytes.size() - 2)));
  EXPECT_TRUE(isCutOff(cut(bytes, segment.size() + 30)));
}

}  // namespace
}  // namespace ardrone_vslam
