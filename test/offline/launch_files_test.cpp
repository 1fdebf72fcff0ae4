// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace ardrone_vslam {
namespace {

std::string launchFile(const std::string& name) {
  std::ifstream file(ARDRONE_VSLAM_SOURCE_DIR "/launch/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(LaunchFiles, ReplayHasEveryArgumentOfVslam) {
  const std::string vslam = launchFile("vslam.launch");
  const std::string replay = launchFile("replay.launch");
  const std::regex argument("<arg name=\"(\\w+)\" default=");
  int count = 0;
  for (std::sregex_iterator it(vslam.begin(), vslam.end(), argument), end; it != end; ++it) {
    const std::string name = (*it)[1];
    ++count;
    if (name == "queue_size") continue;  // no image of a bag is to be lost
    if (name == "cmd_vel") continue;     // no drone is to fly as it did in the bag
    const std::string start = "<arg name=\"" + name + "\" ";
    EXPECT_NE(replay.find(start + "default="), std::string::npos) << name;
    EXPECT_NE(replay.find(start + "value=\"$(arg " + name + ")\"/>"), std::string::npos) << name;
  }
  EXPECT_GE(count, 13);
}

}  // namespace
}  // namespace ardrone_vslam
