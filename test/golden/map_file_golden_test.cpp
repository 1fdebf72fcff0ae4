// SPDX-License-Identifier: BSD-3-Clause
// Files of schema 1 stay what they are: what was written once is read, and is written the same.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::test {
namespace {

const std::string kGolden = test::dataFile("maps/version_1.vmap");
const std::string kGoldenFlight = test::dataFile("maps/version_1_flight.vmap");
const std::string kGoldenExtrinsics = test::dataFile("maps/version_1_extrinsics.vmap");

TEST(MapFileGolden, AMapIsWrittenAsTheSameBytesEverywhere) {
  const TemporaryFolder folder;
  const std::string path = folder.file("house.vmap");
  ASSERT_EQ(writeMap(path, smallMap()), 3U);
  // test/data/maps/README.md
  if (std::getenv("VSLAM_WRITE_GOLDEN_MAP") != nullptr) writeMap(kGolden, smallMap());
  EXPECT_TRUE(readFile(path) == readFile(kGolden)) << "another file than " << kGolden;
}

TEST(MapFileGolden, TheFileIsReadAndWrittenAgain) {
  const SavedMap map = readMap(kGolden);
  EXPECT_EQ(map.frame_id, "house");
  EXPECT_EQ(map.stamp_ns, 1'000'000'000'000);
  EXPECT_EQ(cameraDifference(map.cameras, mapCamera()), "");
  ASSERT_EQ(map.anchors.size(), 2U);
  EXPECT_EQ(map.anchors[1].stamp_ns, 950'000'000'000);
  EXPECT_EQ(map.anchors[1].T_map_rig.translation(), Eigen::Vector3d(1, -2.5, 0.75));
  EXPECT_LT((map.anchors[1].T_map_rig * Eigen::Vector3d::UnitX() -
             Eigen::Vector3d(1 - 0.28, -2.5, 0.75 + 0.96))
                .norm(),
            1e-12);
  EXPECT_EQ(map.anchor_covariance, smallMap().anchor_covariance);
  ASSERT_EQ(map.landmarks.size(), 3U);
  const Landmark& last = map.landmarks[2];
  EXPECT_EQ(last.position_map, Eigen::Vector3d(2.1, 0.2, 0.3));
  EXPECT_EQ(last.descriptor.words[7], 0x0123456789ABCDEFU + 9);
  EXPECT_EQ(last.covariance_m2.full()(2, 0), -0.001953125);
  EXPECT_EQ(last.view_direction_map, Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(last.seen_distance_m, 4.5);
  EXPECT_EQ(last.parallax_rad, 0.0625);
  EXPECT_EQ(last.anchor_id, 1U);
  EXPECT_EQ(last.times_seen, 22);
  EXPECT_EQ(last.times_failed, 2);
  EXPECT_EQ(last.first_seen_ns, 940'000'000'000);
  EXPECT_EQ(last.last_seen_ns, 999'998'000'000);

  const TemporaryFolder folder;
  writeMap(folder.file("again.vmap"), map);
  EXPECT_TRUE(readFile(folder.file("again.vmap")) == readFile(kGolden));
}

TEST(MapFileGolden, AFlightGoesAlong) {
  const TemporaryFolder folder;
  const std::string path = folder.file("house.vmap");
  SavedMap map = smallMap();
  map.flight = smallFlight();
  writeMap(path, map);
  if (std::getenv("VSLAM_WRITE_GOLDEN_MAP") != nullptr) writeMap(kGoldenFlight, map);
  EXPECT_TRUE(readFile(path) == readFile(kGoldenFlight)) << "another file than " << kGoldenFlight;
  EXPECT_TRUE(readMap(kGoldenFlight).flight.keyframes.empty());  // unless it is asked for
  map = readMap(kGoldenFlight, WithFlight::kYes);
  writeMap(path, map);
  EXPECT_TRUE(readFile(path) == readFile(kGoldenFlight));
  EXPECT_EQ(map.flight.config.odometry.scale_sigma, 0.0625);
  EXPECT_EQ(map.flight.config.track_sigma_px, 0.5);
  ASSERT_EQ(map.flight.keyframes.size(), 2U);
  EXPECT_EQ(map.flight.keyframes[0].views.at(1).track_id, 8U);
  EXPECT_FALSE(map.flight.keyframes[0].height_m);
  const Keyframe& last = map.flight.keyframes[1];
  EXPECT_EQ(last.stamp_ns, 950'000'000'000);
  EXPECT_EQ(last.T_map_base.matrix(), smallMap().anchors[1].T_map_rig.matrix());
  EXPECT_EQ(last.T_odom_base.translation(), Eigen::Vector3d(1, -2, 0.5));
  EXPECT_EQ(last.T_base_cam.linear()(0, 2), 1);
  EXPECT_EQ(last.focal_length_px, 500);
  EXPECT_EQ(last.way_variance_m2, 0.25);
  EXPECT_EQ(last.way_m, 4);
  EXPECT_EQ(last.height_m, -0.5);
  EXPECT_EQ(last.floor, 1);
  EXPECT_EQ(last.views.at(0).bearing_cam, Eigen::Vector3f(0, 0.6F, 0.8F));
  EXPECT_EQ(last.views[0].information_rad2(1, 0), -128);
  EXPECT_EQ(last.landmarks.at(0).landmark_id, 2U);
  EXPECT_EQ(last.landmarks.at(1).landmark_id, 4U);  // behind those of the file
  EXPECT_EQ(last.passed.at(0).stamp_ns, 925'000'000'000);
}

TEST(MapFileGolden, SoDoExtrinsicsThatAreEstimated) {
  const TemporaryFolder folder;
  const std::string path = folder.file("house.vmap");
  SavedMap map = smallMap();
  map.flight = smallFlight();
  map.flight.config.odometry.extrinsics_sigma_deg = 0.25;
  writeMap(path, map);
  if (std::getenv("VSLAM_WRITE_GOLDEN_MAP") != nullptr) writeMap(kGoldenExtrinsics, map);
  EXPECT_TRUE(readFile(path) == readFile(kGoldenExtrinsics));
  map = readMap(kGoldenExtrinsics, WithFlight::kYes);
  EXPECT_EQ(map.flight.config.odometry.extrinsics_sigma_deg, 0.25);
  EXPECT_EQ(map.flight.keyframes.size(), 2U);
}

}  // namespace
}  // namespace ardrone_vslam::test
