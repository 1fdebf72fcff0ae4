// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "driver/fake_driver_setup.hpp"
#include "folders/camera_yaml.hpp"
#include "sequences/drone_cameras.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

std::string launchFile(const std::string& name) {
  std::ifstream file(test::packageFile("launch/") + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Arguments of vslam.launch that `outer`, which includes it, does not offer and hand on.
int expectArgumentsOfVslam(const std::string& outer, const std::vector<std::string>& except) {
  const std::string vslam = launchFile("vslam.launch");
  const std::string text = launchFile(outer);
  const std::regex argument("<arg name=\"(\\w+)\" default=");
  int count = 0;
  for (std::sregex_iterator it(vslam.begin(), vslam.end(), argument), end; it != end; ++it) {
    const std::string name = (*it)[1];
    ++count;
    if (std::find(except.begin(), except.end(), name) != except.end()) continue;
    const std::string start = "<arg name=\"" + name + "\" ";
    EXPECT_NE(text.find(start + "default="), std::string::npos) << outer << ": " << name;
    EXPECT_NE(text.find(start + "value=\"$(arg " + name + ")\"/>"), std::string::npos)
        << outer << ": " << name;
  }
  return count;
}

TEST(LaunchFiles, ReplayHasEveryArgumentOfVslam) {
  // No image of a bag is to be lost; no drone is to fly as it did in the bag.
  EXPECT_GE(expectArgumentsOfVslam("replay.launch", {"queue_size", "cmd_vel", "observer_fusion"}),
            13);
}

TEST(LaunchFiles, ArdroneHasEveryArgumentOfVslam) {
  EXPECT_GE(expectArgumentsOfVslam("ardrone.launch", {"observer_fusion"}), 13);
}

/// What ardrone.launch sets of the fake driver is a parameter of it.
TEST(LaunchFiles, ArdroneSetsParametersThatTheFakeDriverHas) {
  std::string known;
  known = " tf_prefix ";  // ROS's own
  FakeDriverConfig config;
  visitParameters(config, [&known](const ParameterInfo& info, const auto& /*value*/) {
    known += std::string(" ") + info.name + " ";
  });
  const std::string text = launchFile("ardrone.launch");
  const std::size_t begin = text.find("type=\"fake_driver\"");
  ASSERT_NE(begin, std::string::npos);
  const std::string node = text.substr(begin, text.find("</node>", begin) - begin);
  const std::regex parameter("<param name=\"(\\w+)\"");
  int count = 0;
  for (std::sregex_iterator it(node.begin(), node.end(), parameter), end; it != end; ++it) {
    EXPECT_NE(known.find(" " + std::string((*it)[1]) + " "), std::string::npos) << (*it)[1];
    ++count;
  }
  EXPECT_GE(count, 7);
}

TEST(LaunchFiles, DefaultCalibrationsAreThoseOfTheStream) {
  const std::string folder = test::packageFile("config/camera_info/");
  const CameraIntrinsics front = readCameraYaml(folder + "ardrone_front.yaml");
  const CameraIntrinsics bottom = readCameraYaml(folder + "ardrone_bottom.yaml");
  for (const CameraIntrinsics& camera : {front, bottom}) {
    EXPECT_EQ(camera.width_px, 640);
    EXPECT_EQ(camera.height_px, 360);
    EXPECT_NO_THROW(WorldRenderer{camera}) << "the lens folds back";
  }
  EXPECT_NEAR(front.fx_px, arDroneFrontCamera().fx_px, 20);
  // Cut from twice 320x240.
  EXPECT_NEAR(bottom.fx_px, 2 * cameraNamed("bottom").intrinsics.fx_px, 70);
}

}  // namespace
}  // namespace ardrone_vslam
