// SPDX-License-Identifier: BSD-3-Clause
#include "loop/flight_map.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "loop/onboard_loop.hpp"
#include "onboard/wall_flight.hpp"
#include "support/file_size_limit.hpp"

namespace ardrone_vslam::test {
namespace {

class FlightMapTest : public WallFlight {
 protected:
  FlightMapTest() {
    settings_.tracker.corners.features_per_frame = 200;
    settings_.save_map = file("map");
  }
  /// What the map is refused with; empty: it was saved, or nothing was to be.
  std::string fly() {
    try {
      OnboardLoop loop(settings_, stop_.ends[0]);
      EXPECT_TRUE(loop.run());
      said_ = loop.saveMap();
    } catch (const MapFileError& error) {
      return error.what();
    }
    return "";
  }
  /// The map of one flight is the next one's.
  void makeLoaded() {
    ASSERT_EQ(fly(), "");
    writeFile(file("loaded"), readFile(file("map")));
    settings_.map_file = file("loaded");
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  std::string said_;
};

TEST_F(FlightMapTest, IsSavedAtTheEnd) {
  EXPECT_EQ(fly(), "");
  const SavedMap map = readMap(file("map"), WithFlight::kYes);
  EXPECT_GT(map.landmarks.size(), 50U);
  ASSERT_GT(map.flight.keyframes.size(), 2U);  // for map_tool refine
  EXPECT_GT(map.flight.keyframes.back().views.size(), 20U);
  EXPECT_EQ(said_, std::to_string(map.landmarks.size()) + " landmarks written to " + file("map"));
}

TEST_F(FlightMapTest, WhatAnEarlierFlightLeftIsKept) {
  writeFile(file("map"), "yesterday's");
  settings_.autosave_s = 1e-9;
  EXPECT_EQ(fly(), "");
  EXPECT_GT(readMap(file("map")).landmarks.size(), 50U);
  EXPECT_EQ(readFile(file("map") + ".before"), "yesterday's");
}

TEST_F(FlightMapTest, IsSavedInFlightAndNoPoseIsAnother) {
  settings_.autosave_s = 3600;
  OnboardLoop(settings_, stop_.ends[0]).run();
  EXPECT_EQ(readFile(file("map")), "") << "its time had not come";
  const auto expected = posesIn(file("poses"));
  settings_.autosave_s = 1e-9;  // whenever the last one is on the disk
  OnboardLoop(settings_, stop_.ends[0]).run();
  // Of the flight's first half or its end: the child gives way to all that a machine is at.
  const SavedMap map = readMap(file("map"), WithFlight::kYes);
  EXPECT_GT(map.landmarks.size(), 0U);
  EXPECT_GT(map.flight.keyframes.size(), 0U);
  const auto answers = posesIn(file("poses"));
  ASSERT_EQ(answers.size(), expected.size());
  for (std::size_t i = 0; i < answers.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(answers[i].position_m[k], expected[i].position_m[k]) << i;
}

TEST_F(FlightMapTest, TheNextFlightIsFoundInIt) {
  makeLoaded();
  EXPECT_EQ(fly(), "");
  const auto answers = poses();
  EXPECT_EQ(answers.front().state, static_cast<std::uint32_t>(VSLAM_SEARCHING_MAP));
  EXPECT_GT(answers.front().deviation[0], 100) << "the place is not known yet";
  EXPECT_NE(answers[kAlong - 1].state, static_cast<std::uint32_t>(VSLAM_SEARCHING_MAP));
  EXPECT_LT(answers[kAlong - 1].deviation[0], 1);
  EXPECT_GE(readMap(file("map")).landmarks.size(), readMap(file("loaded")).landmarks.size());
}

TEST_F(FlightMapTest, LocaliseOnlySavesNothing) {
  makeLoaded();
  std::remove(file("map").c_str());
  settings_.autosave_s = 1e-9;
  settings_.mapper.msckf.localise_only = true;
  EXPECT_EQ(fly(), "");
  EXPECT_EQ(readFile(file("map")), "");
  EXPECT_TRUE(has(said_, "localise_only")) << said_;
}

TEST_F(FlightMapTest, AFlightThatIsNotFoundSavesNothing) {
  makeLoaded();
  const std::string before = readFile(file("map"));
  // Nothing of the wall is in the picture.
  std::string frames;
  for (int i = 0; i < kAlong; ++i) frames += pgm(stampOf(i), TestImage(160, 120));
  writeFile(file("frames"), frames);
  settings_.autosave_s = 1e-9;
  const std::string fault = fly();
  EXPECT_TRUE(has(fault, "was not found")) << fault;
  EXPECT_EQ(readFile(file("map")), before);
}

TEST_F(FlightMapTest, AFlightWithoutALandmarkLeavesTheFile) {
  ASSERT_EQ(fly(), "");
  const std::string before = readFile(file("map"));
  writeFile(file("frames"), "");
  settings_.autosave_s = 1e-9;
  EXPECT_EQ(fly(), "");
  EXPECT_TRUE(has(said_, "no landmark")) << said_;
  EXPECT_EQ(readFile(file("map")), before);
}

TEST_F(FlightMapTest, AClockThatIsSetLosesNoMap) {
  makeLoaded();
  // After the flight its beginning once more: the map begins anew, in the loaded one.
  const std::string once = readFile(file("frames"));
  writeFile(file("frames"), once + once.substr(0, 4 * once.size() / kAlong));
  for (const bool has_loaded : {true, false}) {
    if (!has_loaded) settings_.map_file.clear();
    settings_.autosave_s = 1e-9;
    const std::string fault = fly();
    EXPECT_EQ(has(fault, "not found in this map"), has_loaded) << fault;
    // However few its writer, which gives way to everything else, had the time to save.
    EXPECT_GT(readMap(file("map")).landmarks.size(), 0U) << "an empty map took its place";
  }
  EXPECT_TRUE(has(said_, "stays as it was")) << said_;
}

TEST_F(FlightMapTest, AFailedWriterIsNoFaultOfTheFlight) {
  settings_.autosave_s = 1e-9;
  const FileSizeLimit full(100);
  settings_.onboard.poses = "";
  OnboardLoop loop(settings_, stop_.ends[0]);
  EXPECT_TRUE(loop.run());
  EXPECT_THROW(loop.saveMap(), MapFileError);
  EXPECT_EQ(readFile(file("map")), "");
}

TEST_F(FlightMapTest, WhatCannotBeLoadedIsRefusedAtTheStart) {
  makeLoaded();
  std::string fault;
  settings_.mapper.landmark_map.max_landmarks = 20;
  fault = fly();
  EXPECT_TRUE(has(fault, "map_tool prune --most 20")) << fault;
  settings_.mapper.landmark_map.max_landmarks = 1000;
  writeFile(file("camera.yaml"),
            "image_width: 160\nimage_height: 120\ncamera_matrix:\n  data: [250, 0, 80, 0, 250, 60, "
            "0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  data: []\n");
  fault = fly();
  EXPECT_TRUE(has(fault, file("loaded")) && has(fault, "focal length")) << fault;
  writeFile(file("loaded"), "id,x_m,y_m\n1,2,3\n");
  fault = fly();
  EXPECT_TRUE(has(fault, file("loaded"))) << fault;
  settings_.map_file = file("none");
  fault = fly();
  EXPECT_TRUE(has(fault, file("none"))) << fault;
}

TEST_F(FlightMapTest, WhatCannotBeWrittenIsSaidAtTheStart) {
  settings_.save_map = file("no/folder/map");
  const std::string fault = fly();
  EXPECT_TRUE(has(fault, "no/folder/map")) << fault;
  EXPECT_TRUE(poses().empty()) << "it has flown";
}

}  // namespace
}  // namespace ardrone_vslam::test
