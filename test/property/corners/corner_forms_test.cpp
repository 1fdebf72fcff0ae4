// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>

#include "corners/corner_detector.hpp"
#include "support/fast_scan.hpp"

// The detector as a whole is the same with every instruction set.
namespace ardrone_vslam::test {
namespace {

TEST(CornerForms, EqualOnWideImagesWithAdaptingThresholds) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    for (int trial = 0; trial < 12; ++trial) {
      CornerDetectorConfig config;
      config.arc_length_px = uniformInt(random, 9, 12);
      config.sampling_passes = trial % 2 == 0 ? 16 : uniformInt(random, 1, 15);
      config.suppression =
          uniformInt(random, 0, 2) == 0 ? Suppression::kStrict3x3 : Suppression::kLocalClimb;
      config.features_per_frame = uniformInt(random, 10, 400);
      config.cell_size_px = uniformInt(random, 16, 90);
      GreyImage image(uniformInt(random, 7, 400), uniformInt(random, 7, 120),
                      uniformInt(random, 0, 40));
      CornerDetector scalar(config, InstructionSet::kScalar);
      std::vector<std::unique_ptr<CornerDetector>> detectors;
      for (const InstructionSet set : supportedInstructionSets())
        detectors.push_back(std::make_unique<CornerDetector>(config, set));
      for (int frame = 0; frame < 5; ++frame) {
        fillBlocks(image, {uniformInt(random, 1, 5), uniformInt(random, 2, 256), 255, 3}, random);
        std::vector<Corner> expected;
        scalar.detect(image.view(), expected);
        for (std::size_t i = 0; i < detectors.size(); ++i) {
          std::vector<Corner> corners;
          detectors[i]->detect(image.view(), corners);
          expectSameCorners(corners, expected, supportedInstructionSets()[i]);
        }
      }
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
