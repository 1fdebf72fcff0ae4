// SPDX-License-Identifier: BSD-3-Clause
// Streams of pictures that can be decoded: another camera or size in mid-stream, a restarted drone,
// a clock that stands still.
#include "pave_sequence.hpp"

#include <algorithm>

#include "support/h264_pictures.hpp"
#include "support/pave_packets.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

/// Groups of 5 frames, each of another grey.
class Capture {
 public:
  /// @param number  of the first frame @param timestamp_ms  likewise; 33 more for each
  void add(int groups, unsigned width_px, unsigned height_px, std::uint32_t number,
           std::int64_t timestamp_ms, int step_ms = 33) {
    H264Pictures pictures(width_px, height_px);
    for (int i = 0; i < 5 * groups; ++i) {
      const bool is_idr = i % 5 == 0;
      if (is_idr) luma_ = static_cast<std::uint8_t>(luma_ + 10);
      Packet packet = is_idr ? idr(number) : dependent(number);
      packet.width_px = static_cast<std::uint16_t>(width_px);
      packet.height_px = static_cast<std::uint16_t>(height_px);
      packet.timestamp_ms = timestamp_ms;
      packet.payload = is_idr ? pictures.idr(luma_) : pictures.repeated();
      const Bytes bytes = toBytes(packet);
      text_.append(bytes.begin(), bytes.end());
      lumas_.push_back(luma_);
      ++number;
      timestamp_ms += step_ms;
    }
  }
  const std::string& text() const { return text_; }
  /// Of each frame added.
  const std::vector<std::uint8_t>& lumas() const { return lumas_; }

 private:
  std::string text_;
  std::uint8_t luma_ = 40;
  std::vector<std::uint8_t> lumas_;
};

std::string cameraYaml(int width_px, int height_px) {
  std::string yaml = textCameraYaml("plumb_bob", "0, 0, 0, 0, 0");
  const auto replace = [&yaml](const std::string& from, const std::string& to) {
    ASSERT_NE(yaml.find(from), std::string::npos) << yaml;
    yaml.replace(yaml.find(from), from.size(), to);
  };
  replace("image_width: 32", "image_width: " + std::to_string(width_px));
  replace("image_height: 24", "image_height: " + std::to_string(height_px));
  return yaml;
}

class PaveSequenceTest : public testing::Test {
 protected:
  PaveSequenceTest() { folder_.write("camera.yaml", cameraYaml(32, 24)); }

  std::unique_ptr<PaveSequence> open(const Capture& capture, const std::string& bottom = {}) {
    folder_.write("video.pave", capture.text());
    PaveOptions options;
    options.bottom_camera_yaml = bottom;
    return openPave(folder_.file("video.pave"), options);
  }
  TemporaryFolder folder_;
};

/// Decoding gives each frame's own picture, whatever came before it.
void expectPictures(PaveSequence& sequence, const std::vector<std::uint8_t>& lumas) {
  ASSERT_EQ(sequence.size(), lumas.size());
  for (std::size_t i = 0; i < lumas.size(); ++i) {
    const cv::Mat image = sequence.image(i);
    const CameraIntrinsics camera = sequence.cameraAt(sequence.cameraOf(i)).intrinsics;
    ASSERT_EQ(image.size(), cv::Size(camera.width_px, camera.height_px)) << i;
    // Video's grey is 16 to 235.
    ASSERT_NEAR(cv::mean(image)[0], (lumas[i] - 16) * 255.0 / 219, 2) << i;
    if (i == 0) continue;
    ASSERT_GT(sequence.stamp_ns(i), sequence.stamp_ns(i - 1)) << i;
  }
}

std::string warningsOf(const PaveSequence& sequence) {
  std::string all;
  for (const std::string& warning : sequence.warnings()) all += warning + "\n";
  return all;
}

TEST_F(PaveSequenceTest, ASoundStreamHasNoWarning) {
  Capture capture;
  capture.add(6, 32, 24, 1, 5000);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_EQ(warningsOf(*sequence), "");
  EXPECT_EQ(sequence->stamp_ns(29), 5957 * std::int64_t{1'000'000});
}

TEST_F(PaveSequenceTest, TheBottomCameraInMidStreamIsACameraOfItsOwn) {
  folder_.write("bottom.yaml", cameraYaml(48, 32));
  Capture capture;
  capture.add(4, 32, 24, 1, 5000);
  capture.add(3, 48, 32, 21, 5660);
  capture.add(2, 32, 24, 36, 6155);
  const auto sequence = open(capture, folder_.file("bottom.yaml"));
  expectPictures(*sequence, capture.lumas());
  EXPECT_EQ(warningsOf(*sequence), "");
  EXPECT_EQ(sequence->cameraOf(19), 0U);
  EXPECT_EQ(sequence->cameraOf(20), 1U);
  EXPECT_EQ(sequence->cameraOf(34), 1U);
  EXPECT_EQ(sequence->cameraOf(35), 0U);
  // The driver's mounting: it looks down.
  const Eigen::Matrix3d R = sequence->cameraAt(1).T_base_cam.linear();
  EXPECT_TRUE(R.col(2).isApprox(-Eigen::Vector3d::UnitZ()));
}

TEST_F(PaveSequenceTest, CamerasOfOneSizeCannotBeToldApart) {
  Capture capture;
  capture.add(4, 32, 24, 1, 5000);
  expectError([&] { open(capture, folder_.file("camera.yaml")); },
              {"camera.yaml", "does not tell the two apart", "--frames"});
}

TEST_F(PaveSequenceTest, ASizeWithoutCalibrationIsCountedAndTheRestGoesOn) {
  Capture capture;
  capture.add(4, 32, 24, 1, 5000);
  capture.add(3, 48, 32, 21, 5660);
  capture.add(2, 32, 24, 36, 6155);
  const auto sequence = open(capture);
  std::vector<std::uint8_t> front = capture.lumas();
  front.erase(front.begin() + 20, front.begin() + 35);
  expectPictures(*sequence, front);
  EXPECT_EQ(warningsOf(*sequence),
            "15 frames are 48x32, of another camera without calibration (--bottom-camera), and are "
            "left out\n");
}

TEST_F(PaveSequenceTest, TheFrontCameraAtAnotherSizeKeepsItsCalibrationScaled) {
  Capture capture;
  capture.add(2, 64, 48, 1, 5000);
  capture.add(3, 32, 24, 11, 5330);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_EQ(warningsOf(*sequence),
            "10 frames are 64x48: taken for the front camera's, its calibration scaled\n");
  const CameraIntrinsics front = sequence->cameraAt(1).intrinsics;
  EXPECT_EQ(sequence->camera().width_px, 64);
  EXPECT_DOUBLE_EQ(sequence->camera().fx_px, 2 * front.fx_px);
  EXPECT_DOUBLE_EQ(sequence->camera().cx_px, 2 * front.cx_px + 0.5);
}

TEST_F(PaveSequenceTest, WhatComesAfterARestartIsKept) {
  Capture capture;
  capture.add(4, 32, 24, 900, 500'000);
  capture.add(6, 32, 24, 1, 2000);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_NE(warningsOf(*sequence).find("1 times the drone was restarted"), std::string::npos)
      << warningsOf(*sequence);
}

TEST_F(PaveSequenceTest, EqualStampsAreSpreadWithAWarning) {
  Capture capture;
  capture.add(6, 32, 24, 1, 5000, 0);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_NE(warningsOf(*sequence).find("30 frames are of a clock that stands still"),
            std::string::npos)
      << warningsOf(*sequence);
}

}  // namespace
}  // namespace ardrone_vslam
