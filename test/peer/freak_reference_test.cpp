// SPDX-License-Identifier: BSD-3-Clause
// All reference descriptors of real images; OpenCV only reads the image files.
#include "support/freak_reference.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "support/real_data.hpp"

namespace ardrone_vslam::test {
namespace {

struct RealImage {
  const char* name;
  const char* path;
};

class FreakReference : public ::testing::TestWithParam<RealImage> {};

TEST_P(FreakReference, EveryBitAndEveryAngleIsThePublishedDescriptors) {
  if (realData().empty())
    GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set: the real images are not compared";
  const std::string folder = realData() + "/";
  const auto all_rows = readFreakRows(folder + "freak_reference/freak_reference.csv");
  const cv::Mat pixels = cv::imread(folder + GetParam().path, cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(pixels.empty()) << folder << GetParam().path << " cannot be read";
  const ImageView image{pixels.data, pixels.cols, pixels.rows,
                        static_cast<std::ptrdiff_t>(pixels.step)};
  std::size_t compared = 0;
  for (const char* mode : {"oriented", "upright", "oriented_scaled"}) {
    const auto rows = rowsOf(all_rows, GetParam().name, mode);
    for (const InstructionSet set : supportedInstructionSets()) {
      for (const std::string& difference : differencesFrom(rows, image, set))
        ADD_FAILURE() << difference;
    }
    compared += rows.size();
  }
  EXPECT_GE(compared, 300U) << "rows of " << GetParam().name << " in freak_reference.csv";
}

INSTANTIATE_TEST_SUITE_P(
    Images, FreakReference,
    ::testing::Values(RealImage{"generated_320x240", "freak_reference/generated_320x240.png"},
                      RealImage{"graf_img1", "graf/img1.ppm"},
                      RealImage{"mandrill", "images_512/mandrill.png"},
                      RealImage{"kitti_03_000000", "kitti_03/image_0/000000.png"},
                      RealImage{"kitti_02_turn_000025", "kitti_02_turn/image_0/000025.png"}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace ardrone_vslam::test
