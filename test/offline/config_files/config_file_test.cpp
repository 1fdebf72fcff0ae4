// SPDX-License-Identifier: BSD-3-Clause
#include "config_files/config_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "configs/node_config.hpp"
#include "configs/onboard_config.hpp"
#include "parameters/parameter_table.hpp"
#include "support/contains.hpp"
#include "support/sequence_folders.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

class ConfigFile : public ::testing::Test {
 protected:
  PipelineConfig load(const std::string& text, const std::vector<std::string>& overrides = {}) {
    folder_.write("config.yaml", text);
    return loadConfig(folder_.file("config.yaml"), overrides);
  }
  std::vector<std::string> faultsOf(const std::string& text,
                                    const std::vector<std::string>& overrides = {}) {
    try {
      load(text, overrides);
    } catch (const ConfigError& e) {
      return e.faults();
    }
    return {};
  }

  TemporaryFolder folder_;
};

using test::contains;

TEST_F(ConfigFile, ReadsBothSectionsAndKeepsDefaults) {
  const PipelineConfig config = load(
      "tracker:\n  features_per_frame: 321\n  use_attitude: on\n  track_search_radius_px: 70.5\n"
      "mapper:\n  estimator: thesis\n  planar: true\n  known_height_m: 50\n");
  EXPECT_EQ(config.tracker.corners.features_per_frame, 321);
  EXPECT_TRUE(config.tracker.use_attitude);
  EXPECT_EQ(config.tracker.tracks.search_radius_px, 70.5);
  EXPECT_EQ(config.mapper.estimator, EstimatorKind::kThesis);
  EXPECT_TRUE(config.mapper.planar);
  EXPECT_EQ(config.mapper.height_input.known_height_m, 50);
  EXPECT_EQ(config.mapper.landmark_map.max_landmarks, LandmarkMapConfig{}.max_landmarks);
}

TEST_F(ConfigFile, AnOffsetIsANumberOrAuto) {
  const auto offsetOf = [this](const std::string& text) {
    return load("mapper:\n  image_time_offset_s: " + text + "\n").mapper.image_time_offset_s;
  };
  EXPECT_EQ(offsetOf("auto"), NumberOrAuto{});
  EXPECT_EQ(offsetOf("-0.25"), -0.25);
  EXPECT_EQ(loadConfig("", {"mapper/image_time_offset_s=0"}).mapper.image_time_offset_s, 0.0);
  EXPECT_EQ(faultsOf("mapper:\n  image_time_offset_s: late\n"),
            std::vector<std::string>{"mapper/image_time_offset_s is 'late' but must be a number or "
                                     "auto [s]"});
  EXPECT_EQ(faultsOf("mapper:\n  image_time_offset_s: 6\n").size(), 1U) << "out of range";
}

TEST_F(ConfigFile, EmptyPathFileAndSectionsAreTheDefaults) {
  EXPECT_NO_THROW(loadConfig("", {}));
  EXPECT_NO_THROW(load(""));
  EXPECT_NO_THROW(load("tracker:\n  # all commented out\nmapper:\n"));
}

TEST_F(ConfigFile, OverridesStandAboveTheFile) {
  const std::string text = "mapper:\n  known_height_m: 50\n";
  EXPECT_EQ(load(text, {"known_height_m=60"}).mapper.height_input.known_height_m, 60);
  EXPECT_EQ(load(text, {"mapper/known_height_m=70"}).mapper.height_input.known_height_m, 70);
  EXPECT_EQ(
      load(text, {"known_height_m=60", "known_height_m=80"}).mapper.height_input.known_height_m,
      80);
  EXPECT_EQ(load(text, {"features_per_frame=99"}).tracker.corners.features_per_frame, 99)
      << "a tracker's parameter is known without its section";
  EXPECT_EQ(loadConfig("", {"estimator=odometry"}).mapper.estimator, EstimatorKind::kOdometry);
}

TEST_F(ConfigFile, EveryFaultIsListedAtOnce) {
  const auto faults = faultsOf(
      "tracker:\n  features_per_frame: many\n  cell_size_px: 12.5\n  frobnicate: 1\n"
      "mapper:\n  estimator: median\n  planar: perhaps\n  known_height_m: -3\n  track_sigma_px: "
      ".nan\n"
      "recorder:\n  rate: 3\n",
      {"no_equals_sign", "=3", "min_landmarks=0"});
  const std::vector<std::string> expected{
      "--set 'no_equals_sign' must be key=value",
      "--set '=3' must be key=value",
      "tracker/features_per_frame is 'many' but must be a whole number",
      "tracker/cell_size_px is '12.5' but must be a whole number",
      "tracker/frobnicate is not a parameter",
      "mapper/estimator is 'median' but must be one of: thesis, msckf, odometry",
      "mapper/planar is 'perhaps' but must be a switch (true or false)",
      "known_height_m is -3 but must be between",
      "track_sigma_px is nan but must be between",
      "min_landmarks is 0 but must be between",
      "unknown section 'recorder'"};
  ASSERT_EQ(faults.size(), expected.size()) << ::testing::PrintToString(faults);
  for (const std::string& part : expected) {
    EXPECT_TRUE(std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) {
      return contains(fault, part);
    })) << part;
  }
}

TEST_F(ConfigFile, ANumberThatSomeReadAsAnOctalOneIsRefused) {
  for (const char* const text :
       {"tracker:\n  features_per_frame: 0100\n", "mapper:\n  scale_sigma: 01\n"}) {
    const auto faults = faultsOf(text);
    ASSERT_EQ(faults.size(), 1U) << text;
    EXPECT_TRUE(contains(faults[0], "without zeros before it")) << faults[0];
  }
  EXPECT_TRUE(faultsOf("mapper:\n  scale_sigma: 0.02\n  velocity_bias_m_s: 0\n").empty());
}

TEST_F(ConfigFile, WhatIsThereTwiceIsRefused) {
  auto faults = faultsOf("mapper:\n  planar: true\ntracker:\nmapper:\n  min_landmarks: 5\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(contains(faults[0], "section 'mapper' is there twice; put all its keys under one"));
  faults = faultsOf("mapper:\n  planar: true\n  planar: false\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(contains(faults[0], "'mapper/planar' is there twice; keep one of them"));
}

TEST_F(ConfigFile, UnknownKeysGetAHint) {
  const auto hintOf = [this](const std::string& key) {
    const auto faults = faultsOf("mapper:\n  " + key + ": 1\n");
    return faults.size() == 1 ? faults[0] : std::string("no single fault");
  };
  EXPECT_TRUE(
      contains(hintOf("landmark_treshold_px"), "did you mean mapper/landmark_threshold_px"));
  EXPECT_TRUE(contains(hintOf("known_height"), "mapper/known_height_m"));
  EXPECT_TRUE(contains(hintOf("features_per_frame"), "did you mean tracker/features_per_frame"));
  EXPECT_FALSE(contains(hintOf("xyzzy_plugh"), "did you mean"));
  const auto faults = faultsOf("", {"feature_per_frame=3"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(contains(faults[0], "tracker/features_per_frame"));
}

TEST_F(ConfigFile, AnOverrideThatIsNoParameterIsNamedAsItWasTyped) {
  const auto faultOf = [this](const std::string& typed) {
    const auto faults = faultsOf("", {typed});
    return faults.size() == 1 ? faults[0] : std::string("no single fault");
  };
  EXPECT_EQ(faultOf("foo=1").rfind("--set 'foo=1': foo is not a parameter", 0), 0U);
  EXPECT_FALSE(contains(faultOf("foo=1"), "mapper")) << faultOf("foo=1");
  EXPECT_TRUE(contains(faultOf("feature_per_frame=3"),
                       "feature_per_frame is not a parameter; did you mean "
                       "tracker/features_per_frame"));
  EXPECT_TRUE(contains(faultOf("tracker/foo=1"), "tracker/foo is not a parameter"));
}

TEST_F(ConfigFile, KeysOfTheNodeletsArePassedOver) {
  EXPECT_NO_THROW(load("tracker:\n  rectified: true\nmapper:\n  odom_frame: \"\"\n"));
  EXPECT_EQ(faultsOf("tracker:\n  odom_frame: x\n").size(), 1U) << "in their own section only";
}

TEST_F(ConfigFile, TheSectionOfOdometryFusionIsCheckedThoughNotUsed) {
  EXPECT_NO_THROW(
      load("odometry_fusion:\n  map_frame: world\n  odometry_buffer_s: 3\n  scale_sigma: 0.1\n"));
  const auto faults = faultsOf("odometry_fusion:\n  odometry_bufer_s: 3\n  scale_sigma: 2\n");
  ASSERT_EQ(faults.size(), 2U) << ::testing::PrintToString(faults);
  EXPECT_TRUE(contains(faults[0], "did you mean odometry_fusion/odometry_buffer_s"));
  EXPECT_TRUE(contains(faults[1], "scale_sigma is 2 but must be between"));
}

TEST_F(ConfigFile, RectifiedIsReadAsTheNodeletsReadIt) {
  EXPECT_FALSE(load("").rectified);
  for (const char* yes : {"true", "True", "yes", "on"}) {
    EXPECT_TRUE(load(std::string("tracker:\n  rectified: ") + yes + "\n").rectified) << yes;
  }
  EXPECT_TRUE(load("", {"rectified=true"}).rectified) << "known without its section";
  EXPECT_FALSE(load("tracker:\n  rectified: true\n", {"tracker/rectified=false"}).rectified);
  const auto faults = faultsOf("", {"rectified=perhaps"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(contains(faults[0], "tracker/rectified is 'perhaps' but must be a switch"));
}

TEST_F(ConfigFile, TheBaseFrameIsReadAsTheNodeletsReadIt) {
  EXPECT_EQ(load("mapper:\n  base_frame: \"\"\n").base_frame, "");
  EXPECT_EQ(load("mapper:\n  base_frame: body\n").base_frame, "body");
  EXPECT_EQ(load("mapper:\n  base_frame: body\n", {"base_frame=mount"}).base_frame, "mount");
}

TEST_F(ConfigFile, FilesThatAreNoConfiguration) {
  EXPECT_EQ(faultsOf("just some words\n").size(), 1U);
  EXPECT_EQ(faultsOf("- a\n- list\n").size(), 1U);
  EXPECT_EQ(faultsOf("tracker: 5\n").size(), 1U);
  const auto broken = faultsOf("mapper:\n  estimator: [exact\n");
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_TRUE(contains(broken[0], "not valid YAML"));
  // yaml-cpp takes it for UTF-32, in which there is nothing.
  const auto zeros = faultsOf(std::string("#\0\0\0", 4) + "\nmapper:\n  scale_sigma: 0.02\n");
  ASSERT_EQ(zeros.size(), 1U);
  EXPECT_TRUE(contains(zeros[0], "byte 1 is of no text")) << zeros[0];
  const std::pair<std::string, std::string> none[] = {
      {folder_.file("missing.yaml"), ": cannot be read"}, {folder_.path(), ": is no file but"}};
  for (const auto& [path, fault] : none) {
    try {
      loadConfig(path, {});
      FAIL() << path;
    } catch (const ConfigError& e) {
      EXPECT_TRUE(contains(e.what(), path + fault)) << e.what();
    }
  }
  const auto long_value =
      faultsOf("tracker:\n  features_per_frame: " + std::string(100'000, 'x') + "\n");
  ASSERT_EQ(long_value.size(), 1U);
  EXPECT_LT(long_value[0].size(), 400U) << "it shows the beginning";
}

TEST(ParameterTable, NamesEveryParameterWithItsDefault) {
  const std::string table = parameterTable();
  PipelineConfig config;
  const auto expectRow = [&](const ParameterInfo& info, const auto&) {
    EXPECT_TRUE(contains(table, "| `" + std::string(info.name) + "` | ")) << info.name;
  };
  visitParameters(config.tracker, expectRow);
  visitParameters(config.mapper, expectRow);
  DelayedFusionConfig delayed_fusion;
  visitParameters(delayed_fusion, expectRow);
  EXPECT_TRUE(
      contains(table, "| `estimator` | mapper | msckf | choice | thesis, msckf, odometry | "));
  EXPECT_TRUE(contains(table, "| `planar` | mapper | false | switch | true, false | "));
  EXPECT_TRUE(
      contains(table, "| `max_landmarks` | mapper | 200000 | landmarks | 10 to 10000000 | "));
  EXPECT_TRUE(
      contains(table, "| `map_frame` | mapper, odometry_fusion, onboard_bridge | \"map\" | "));
  EXPECT_TRUE(contains(table, "| `queue_size` | tracker, mapper | 5 (tracker), 10 (mapper) | "));
}

TEST(ParameterTable, ThePageIsTheTable) {
  std::ifstream file(test::packageFile("docs/parameters.md"));
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(page, parameterTable()) << "replay --list-parameters > docs/parameters.md";
}

/// @return the rows of a heading's table, or of all
/// A row that stands in the tables of two programs counts once.
std::size_t rowsOf(const std::string& table, const std::string& heading = "") {
  std::istringstream lines(table);
  std::string section;
  std::set<std::string> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) section = line.substr(3);
    const bool is_row = line.rfind("| `", 0) == 0;
    if (is_row && (heading.empty() || section == heading)) rows.insert(line);
  }
  return rows.size();
}

/// The parameters of each rank of the page's first part.
using Ranks = std::map<int, std::set<std::string>>;

template <class Config>
void addRanks(Ranks& ranks) {
  Config config;
  visitParameters(config, [&ranks](const ParameterInfo& info, const auto&) {
    if (info.place.part == PagePart::kUser) ranks[info.place.rank].insert(info.name);
  });
}

TEST(ParameterTable, RanksOfWhatToTurnFirstAreOneByOneFromOne) {
  Ranks ranks;
  addRanks<TrackerConfig>(ranks);
  addRanks<TrackerNodeConfig>(ranks);
  addRanks<SlamConfig>(ranks);
  addRanks<MapperNodeConfig>(ranks);
  addRanks<DelayedFusionConfig>(ranks);
  addRanks<OdometryFusionNodeConfig>(ranks);
  addRanks<OnboardConfig>(ranks);
  addRanks<OnboardBridgeConfig>(ranks);
  ASSERT_GE(ranks.size(), 20U);
  int expected = 0;
  for (const auto& [rank, names] : ranks) {
    EXPECT_EQ(rank, ++expected) << "a gap before turnFirst(" << rank << ") of " << *names.begin();
    EXPECT_EQ(names.size(), 1U) << "two have turnFirst(" << rank
                                << "): " << ::testing::PrintToString(names);
  }
}

TEST(ParameterTable, DoesNotGrow) {
  EXPECT_LE(rowsOf(parameterTable()), 80U) << "what nobody turns is a constant beside its use";
  EXPECT_LE(rowsOf(parameterTable(), "What to turn first"), 25U);
  EXPECT_GE(rowsOf(parameterTable(), "What to turn first"), 20U) << "the heading is another one";
}

}  // namespace
}  // namespace ardrone_vslam
