// SPDX-License-Identifier: BSD-3-Clause
// docs/parameters.md, config/*.yaml and the *Config structs say the same.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "config_file.hpp"
#include "parameter_table.hpp"

namespace ardrone_vslam {
namespace {

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ParameterDocs, PageIsTheTableOfTheStructs) {
  EXPECT_EQ(textOf(ARDRONE_VSLAM_SOURCE_DIR "/docs/parameters.md"), parameterTable())
      << "make the page anew: replay --list-parameters > docs/parameters.md";
}

TEST(ParameterDocs, EveryConfigurationLoads) {
  int loaded = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(ARDRONE_VSLAM_SOURCE_DIR "/config")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".yaml" || name == "observer_profiles.yaml") continue;
    EXPECT_NO_THROW(loadConfig(entry.path().string(), {})) << name;
    ++loaded;
  }
  EXPECT_GE(loaded, 2);
}

TEST(ParameterDocs, AKeyThatNoStructHasIsRefusedByName) {
  try {
    loadConfig("", {"tracker/feature_per_frame=500", "mapper/min_landmarks=0"});
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    ASSERT_EQ(e.faults().size(), 2U) << e.what();
    EXPECT_NE(e.faults()[0].find("features_per_frame"), std::string::npos) << e.faults()[0];
    EXPECT_NE(e.faults()[1].find("min_landmarks"), std::string::npos) << e.faults()[1];
  }
}

}  // namespace
}  // namespace ardrone_vslam
