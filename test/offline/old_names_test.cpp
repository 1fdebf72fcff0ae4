// SPDX-License-Identifier: BSD-3-Clause
// Names of earlier versions: none of them is known any more, and each is refused with its new one.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "config_files/config_file.hpp"
#include "configs/fake_driver_config.hpp"
#include "configs/node_config.hpp"
#include "configs/onboard_config.hpp"
#include "support/contains.hpp"
#include "support/sequence_folders.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

using Kind = OldName::Kind;
using Names = std::set<std::string>;

template <class Config>
void add(Config config, Names& names) {
  visitParameters(config, [&names](const ParameterInfo& info, auto&) { names.insert(info.name); });
}

std::map<std::string, Names> namesOfSections() {
  std::map<std::string, Names> names;
  add(TrackerConfig{}, names["tracker"]);
  add(TrackerNodeConfig{}, names["tracker"]);
  add(SlamConfig{}, names["mapper"]);
  add(MapperNodeConfig{}, names["mapper"]);
  add(DelayedFusionConfig{}, names["odometry_fusion"]);
  add(OdometryFusionNodeConfig{}, names["odometry_fusion"]);
  add(FakeDriverConfig{}, names["fake_driver"]);
  add(OnboardConfig{}, names["onboard"]);
  add(OnboardBridgeConfig{}, names["onboard_bridge"]);
  names["path"];  // has none any more
  return names;
}

std::string textOf(const std::string& path) {
  std::ifstream file(test::packageFile(path));
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// @return its path in the package; empty when there is none
std::string fileBelow(const std::string& folder, const std::string& name) {
  const std::filesystem::path root = test::packageFile("");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
    if (entry.path().filename() == name)
      return std::filesystem::relative(entry.path(), root).string();
  return {};
}

using test::contains;

std::vector<std::string> faultsOf(const std::string& yaml) {
  TemporaryFolder folder;
  folder.write("config.yaml", yaml);
  try {
    loadConfig(folder.file("config.yaml"), {});
  } catch (const ConfigError& e) {
    return e.faults();
  }
  return {};
}

TEST(OldNames, EachIsUnknownNowAndTheNewOneExists) {
  const std::map<std::string, Names> known = namesOfSections();
  const Names estimators(EnumNames<EstimatorKind>::kNames.begin(),
                         EnumNames<EstimatorKind>::kNames.end());
  Names seen;
  for (const OldName& old : oldNames()) {
    SCOPED_TRACE(std::string(old.owner) + " " + old.name);
    const std::string name = old.name;
    const std::string now = old.now;
    EXPECT_TRUE(seen.insert(std::string(old.owner) + "/" + name).second) << "twice";
    EXPECT_FALSE(now.empty() && *old.why == '\0') << "neither a new name nor a reason";
    switch (old.kind) {
      case Kind::kParameter:
        ASSERT_EQ(known.count(old.owner), 1U);
        EXPECT_EQ(known.at(old.owner).count(name), 0U);
        EXPECT_TRUE(now.empty() || known.at(old.owner).count(now) == 1) << now;
        break;
      case Kind::kChoice:
        EXPECT_STREQ(old.owner, "estimator");
        EXPECT_EQ(estimators.count(name), 0U);
        EXPECT_EQ(estimators.count(now), 1U);
        break;
      case Kind::kSection:
        EXPECT_EQ(known.count(name), 0U);
        EXPECT_EQ(known.count(now), 1U);
        break;
      case Kind::kOption: {
        const std::string program = textOf(fileBelow("tools", std::string(old.owner) + ".cpp"));
        EXPECT_FALSE(contains(program, '"' + name + '"'));
        EXPECT_TRUE(contains(program, '"' + now + '"'));
        break;
      }
      case Kind::kLaunchArgument: {
        const std::string launch = textOf(std::string("launch/") + old.owner);
        EXPECT_TRUE(contains(launch, "<arg name=\"" + now + "\" default="));
        EXPECT_TRUE(contains(launch, name + ":=$(arg " + name + ")")) << "check_launch refuses it";
        break;
      }
      case Kind::kNode: {
        const std::string nodelets = textOf("nodelet_plugins.xml");
        EXPECT_FALSE(contains(nodelets, name));
        EXPECT_EQ(fileBelow("nodes", name + ".cpp"), "");
        EXPECT_TRUE(contains(nodelets, now) || !fileBelow("nodes", now + ".cpp").empty());
        break;
      }
    }
  }
  EXPECT_GT(seen.size(), 100U);
}

TEST(OldNames, AConfigurationWithOneIsRefusedWithTheNewOne) {
  const auto faults = faultsOf(
      "tracker:\n  arc_length_px: 9\nmapper:\n  estimator: constraint\n  window_frames: 8\n"
      "  mounting_deviation_deg: 1\nobserver_fusion:\n  map_frame: map\n"
      "odometry_fusion:\n  observer_mode: twist\n");
  const std::vector<std::string> expected{
      "mapper/estimator is 'constraint' but must be one of: thesis, msckf, odometry; constraint is "
      "called msckf now",
      "tracker/arc_length_px is not a parameter; it is no parameter any more: the thesis's "
      "experiments",
      "mapper/mounting_deviation_deg is not a parameter; mounting_deviation_deg is called "
      "extrinsics_sigma_deg now",
      "mapper/window_frames is not a parameter; window_frames is called max_clones now",
      "odometry_fusion/observer_mode is not a parameter; observer_mode is called odometry_mode now",
      "unknown section 'observer_fusion'; observer_fusion is called odometry_fusion now"};
  ASSERT_EQ(faults.size(), expected.size()) << ::testing::PrintToString(faults);
  for (const std::string& part : expected) {
    int found = 0;
    for (const std::string& fault : faults) found += contains(fault, part) ? 1 : 0;
    EXPECT_EQ(found, 1) << part << " in " << ::testing::PrintToString(faults);
  }
}

TEST(OldNames, ASingleValueIsRefusedAlike) {
  try {
    loadConfig("", {"track_deviation_px=3"});
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_TRUE(contains(e.what(), "track_deviation_px is called track_sigma_px now")) << e.what();
  }
}

TEST(OldNames, OthersAreNone) {
  EXPECT_EQ(whatBecameOf(Kind::kParameter, "max_clones"), "");
  EXPECT_EQ(whatBecameOf(Kind::kParameter, "rest_depth_m", "tracker"), "");
  EXPECT_EQ(whatBecameOf(Kind::kSection, "rest_depth_m"), "");
}

}  // namespace
}  // namespace ardrone_vslam
