// SPDX-License-Identifier: BSD-3-Clause
// Streams of pictures that can be decoded: another camera or size in mid-stream, a restarted drone,
// a clock that stands still.
#include "pave/pave_sequence.hpp"

#include <algorithm>

#include "support/pave_capture.hpp"

namespace ardrone_vslam {
namespace {

class PaveSequenceTest : public testing::Test {
 protected:
  PaveSequenceTest() { folder_.write("camera.yaml", paveCameraYaml(32, 24)); }

  std::unique_ptr<PaveSequence> open(const PaveCapture& capture, const std::string& bottom = {}) {
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
  PaveCapture capture;
  capture.add(6, 32, 24, 1, 5000);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_EQ(warningsOf(*sequence), "");
  EXPECT_EQ(sequence->stamp_ns(29), 5957 * std::int64_t{1'000'000});
}

TEST_F(PaveSequenceTest, TheBottomCameraInMidStreamIsACameraOfItsOwn) {
  folder_.write("bottom.yaml", paveCameraYaml(48, 32));
  PaveCapture capture;
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
  PaveCapture capture;
  capture.add(4, 32, 24, 1, 5000);
  expectError([&] { open(capture, folder_.file("camera.yaml")); },
              {"camera.yaml", "does not tell the two apart", "--frames"});
}

TEST_F(PaveSequenceTest, ASizeWithoutCalibrationIsCountedAndTheRestGoesOn) {
  PaveCapture capture;
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
  PaveCapture capture;
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
  PaveCapture capture;
  capture.add(4, 32, 24, 900, 500'000);
  capture.add(6, 32, 24, 1, 2000);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_NE(warningsOf(*sequence).find("1 times the drone was restarted"), std::string::npos)
      << warningsOf(*sequence);
}

TEST_F(PaveSequenceTest, EqualStampsAreSpreadWithAWarning) {
  PaveCapture capture;
  capture.add(6, 32, 24, 1, 5000, 0);
  const auto sequence = open(capture);
  expectPictures(*sequence, capture.lumas());
  EXPECT_NE(warningsOf(*sequence).find("30 frames are of a clock that stands still"),
            std::string::npos)
      << warningsOf(*sequence);
}

}  // namespace
}  // namespace ardrone_vslam
