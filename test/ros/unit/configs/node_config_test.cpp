// SPDX-License-Identifier: BSD-3-Clause
// The yaml files are read by the nodelets and by the offline tools: both must know the same keys.
#include "configs/node_config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "config_files/config_file.hpp"
#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"
#include "with_ros/params.hpp"

namespace ardrone_vslam {
namespace {

template <class Config>
std::vector<std::string> namesOf(Config config) {
  std::vector<std::string> names;
  visitParameters(config,
                  [&names](const ParameterInfo& info, auto&) { names.emplace_back(info.name); });
  return names;
}

/// Loads a yaml with all these keys in a section; @return what is wrong with it.
std::string loadingFault(const std::string& section, const std::vector<std::string>& keys) {
  std::string yaml = section + ":\n";
  for (const auto& key : keys) yaml += "  " + key + ": true\n";  // `rectified` is read
  const TemporaryFolder folder;
  folder.write("config.yaml", yaml);
  try {
    loadConfig(folder.file("config.yaml"), {});
  } catch (const ConfigError& e) {
    return e.what();
  }
  return {};
}

TEST(NodeConfig, OfflineToolsPassOverTheNodesKeys) {
  EXPECT_EQ(loadingFault("tracker", namesOf(TrackerNodeConfig{})), "");
  EXPECT_EQ(loadingFault("mapper", namesOf(MapperNodeConfig{})), "");
  EXPECT_EQ(loadingFault("odometry_fusion", namesOf(OdometryFusionNodeConfig{})), "");
}

TEST(NodeConfig, OfflineToolsRefuseOtherKeys) {
  EXPECT_NE(loadingFault("tracker", {"publish_tf"}), "");
  EXPECT_NE(loadingFault("mapper", {"publish_ft"}), "");
}

TEST(NodeConfig, NoNameIsUsedTwiceInANode) {
  const auto check = [](std::vector<std::string> names, const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
    const std::set<std::string> different(names.begin(), names.end());
    EXPECT_EQ(different.size(), names.size());
  };
  check(namesOf(TrackerNodeConfig{}), namesOf(TrackerConfig{}));
  check(namesOf(MapperNodeConfig{}), namesOf(SlamConfig{}));
  check(namesOf(OdometryFusionNodeConfig{}), namesOf(DelayedFusionConfig{}));
  check(namesOf(OnboardBridgeConfig{}), {});
  check(namesOf(CameraNodeConfig{}), {});
}

TEST(NodeConfig, TheBridgesLaunchFileSetsItsParameters) {
  const std::string all = test::readFile(test::packageFile("launch/onboard_bridge.launch"));
  const std::string node =
      all.substr(std::min(all.find("type=\"onboard_bridge_node\""), all.size()));
  const std::vector<std::string> known = namesOf(OnboardBridgeConfig{});
  const std::regex parameter("<param name=\"(\\w+)\"");
  int count = 0;
  for (std::sregex_iterator it(node.begin(), node.end(), parameter), end; it != end; ++it) {
    EXPECT_EQ(std::count(known.begin(), known.end(), (*it)[1].str()), 1) << (*it)[1];
    ++count;
  }
  EXPECT_GE(count, 8);
}

TEST(NodeConfig, ShippedFilesLoad) {
  for (const auto* name : {"kitti.yaml", "wheels_indoor.yaml", "drone.yaml", "ardrone.yaml"}) {
    EXPECT_NO_THROW(loadConfig(test::packageFile("config/") + name, {})) << name;
  }
}

}  // namespace
}  // namespace ardrone_vslam
