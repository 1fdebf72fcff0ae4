// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>

#include "onboard/flight_records.hpp"
#include "protocol/udp.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"
#include "yaml/calibration.hpp"
#include "yaml/yaml_sections.hpp"

namespace ardrone_vslam::test {
namespace {

std::string join(const std::vector<std::string>& faults) {
  std::string text;
  for (const auto& fault : faults) text += fault + "\n";
  return text;
}

YamlSections read(const std::string& text) {
  std::vector<std::string> faults;
  YamlSections sections = readYamlSections(text, faults);
  EXPECT_EQ(join(faults), "");
  return sections;
}

std::string faultsOf(const std::string& text) {
  std::vector<std::string> faults;
  readYamlSections(text, faults);
  return join(faults);
}

TEST(YamlSectionsTest, ReadsWhatTheFilesAreWrittenIn) {
  YamlSections s = read(
      "# head\n---\ntop: 1  # behind\nsection:\n    a: x#y\n\n  # comment\n    b: 'q # r'\n"
      "    c: \"\"\r\n    url: http://a:1\nempty:\n  # nothing\n"
      "matrix:\n  rows: 3\n  data: [1, -2.5e3,\n         4 ]\nend: [a]\n");
  EXPECT_EQ(s[""]["top"], "1");
  EXPECT_EQ(s["section"]["a"], "x#y");
  EXPECT_EQ(s["section"]["b"], "q # r");
  EXPECT_EQ(s["section"]["c"], "");
  EXPECT_EQ(s["section"]["url"], "http://a:1");
  EXPECT_EQ(s.count("empty"), 1U);
  EXPECT_EQ(listOf(s["matrix"]["data"]), (std::vector<std::string>{"1", "-2.5e3", "4"}));
  EXPECT_EQ(listOf(s[""]["end"]), std::vector<std::string>{"a"});
  EXPECT_TRUE(listOf("[]").empty());
}

TEST(YamlSectionsTest, WhatGoesBeyondIsAFaultWithItsLine) {
  for (const char* text :
       {"a:\n  b:\n    c: 1\n", "a:\n  b: 1\n   c: 1\n", "  a: 1\n", "a: {b: 1}\n", "a:\n  - 1\n",
        "a: &x 1\n", "a: |\n  text\n", "a: [1, 2\nb: 3\n", "word\n", "a: 'open\n", "a: 1\na: 2\n",
        "s:\n  a: 1\n  a: 2\n", "s:\n  a: 1\ns:\n  b: 2\n", "\ta: 1\n", "a: b: c\n"})
    EXPECT_NE(faultsOf(text).find("line "), std::string::npos) << text;
  EXPECT_EQ(faultsOf("").size(), 0U);
}

TEST(YamlSectionsTest, NumbersAndSwitchesAreWholeTexts) {
  double number = 0;
  int whole = 0;
  bool is_on = false;
  EXPECT_TRUE(toNumber("-1.5e-3", number));
  EXPECT_EQ(number, -1.5e-3);
  for (const char* text : {"", "1x", "nan", "inf", "1e999", "0x10", " 1", "1 "})
    EXPECT_FALSE(toNumber(text, number)) << text;
  EXPECT_TRUE(toNumber("-12", whole));
  EXPECT_EQ(whole, -12);
  for (const char* text : {"", "1.0", "99999999999", "+", "1e3"})
    EXPECT_FALSE(toNumber(text, whole)) << text;
  EXPECT_TRUE(toSwitch("Off", is_on));
  EXPECT_FALSE(is_on);
  EXPECT_TRUE(toSwitch("yes", is_on));
  EXPECT_TRUE(is_on);
  EXPECT_FALSE(toSwitch("1", is_on));
}

std::string settingsFault(const std::vector<std::string>& overrides) {
  try {
    loadSettings("", overrides);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(SettingsTest, TheDronesOwnConfigurationIsReadWhole) {
  const std::string folder = test::packageFile("config/");
  const Settings s = loadSettings(folder + "ardrone_onboard.yaml", {"onboard/cpu_share=0.25"});
  EXPECT_EQ(s.onboard.frames, "/dev/video2");
  EXPECT_EQ(s.onboard.cpu_share, 0.25);
  EXPECT_EQ(s.tracker.corners.features_per_frame, 150);
  EXPECT_EQ(s.mapper.landmark_map.max_landmarks, 5000);
  EXPECT_EQ(s.odometry_wait_s, 0.1);
  const CameraIntrinsics bottom = readCalibration(s.onboard.camera);
  EXPECT_EQ(bottom.width_px, 320);
  EXPECT_EQ(bottom.fx_px, 350);
  const CameraIntrinsics front = readCalibration(folder + "camera_info/ardrone_front.yaml");
  EXPECT_EQ(front.height_px, 360);
  EXPECT_EQ(front.k1, -0.525);
}

TEST(SettingsTest, TheMapIsBoundedByItsMemory) {
  const Settings s = loadSettings("", {"mapper/max_map_mb=3", "onboard/working_mb=5"});
  EXPECT_EQ(s.mapper.landmark_map.most(), 7500);
  EXPECT_EQ(memory_bytes(s), 8'000'000U);
}

TEST(SettingsTest, EveryFaultIsNamed) {
  EXPECT_NE(settingsFault({"mapper/planr=true"}).find("mapper/planar"), std::string::npos);
  EXPECT_NE(settingsFault({"onboard/cpu_share=2"}).find("cpu_share"), std::string::npos);
  EXPECT_NE(settingsFault({"tracker/features_per_frame=many"}).find("whole number"),
            std::string::npos);
  EXPECT_NE(settingsFault({"mapper/estimator=best"}).find("msckf"), std::string::npos);
  EXPECT_NE(settingsFault({"mapper/odometry_mode=twist"}).find("pose"), std::string::npos);
  EXPECT_NE(settingsFault({"planar=true"}).find("section/key=value"), std::string::npos);
  EXPECT_NE(settingsFault({"maper/planar=true"}).find("unknown section"), std::string::npos);
  EXPECT_NE(settingsFault({"onboard/camera_position_m=[0, 0]"}).find("three numbers"),
            std::string::npos);
  EXPECT_NE(settingsFault({"onboard/camera_rotation_deg=0, 0, x"}).find("three numbers"),
            std::string::npos);
  EXPECT_EQ(settingsFault({"mapper/map_frame=m", "odometry_fusion/odometry_mode=twist"}), "");
  EXPECT_THROW(loadSettings("/nowhere/config.yaml", {}), ConfigError);
}

TEST(SettingsTest, AnOldNameIsRefusedWithTheNewOne) {
  EXPECT_NE(settingsFault({"mapper/track_deviation_px=3"})
                .find("mapper/track_deviation_px is not a parameter; track_deviation_px is called "
                      "track_sigma_px now"),
            std::string::npos);
  EXPECT_NE(settingsFault({"onboard/camera_y_m=1"}).find("is called camera_position_m now"),
            std::string::npos);
  EXPECT_NE(settingsFault({"mapper/estimator=constraint"}).find("constraint is called msckf now"),
            std::string::npos);
  EXPECT_NE(settingsFault({"observer_fusion/odometry_mode=pose"})
                .find("observer_fusion is called odometry_fusion now"),
            std::string::npos);
  EXPECT_NE(settingsFault({"mapper/watchdog_s=1"}).find("it is no parameter any more"),
            std::string::npos);
}

TEST(UdpAddress, IsAnAddressAndAPort) {
  EXPECT_EQ(udpAddressOf("192.168.1.2", 5582).port, 5582);
  EXPECT_EQ(udpAddressOf("192.168.1.2:80", 5582).port, 80);
  EXPECT_EQ(udpAddressOf("192.168.1.2:80", 5582).host, "192.168.1.2");
  for (const char* text : {"192.168.1.2:", "192.168.1.2:x", "192.168.1.2:65536", "192.168.1.2:-1"})
    EXPECT_THROW(udpAddressOf(text, 1), std::runtime_error) << text;
  EXPECT_TRUE(isUdpAddress("0.0.0.0:0"));
  for (const char* text : {"", "observer.bin", "/tmp/fifo", "drone:5580"})
    EXPECT_FALSE(isUdpAddress(text)) << text;
}

TEST(SettingsTest, FilesThatAreNoneAreRefused) {
  const auto faultOf = [](const std::string& path) -> std::string {
    try {
      loadSettings(path, {});
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {std::string("/dev/zero"), std::string("/"), pipe})
    EXPECT_NE(faultOf(path).find(path + ": is no file but"), std::string::npos) << faultOf(path);
  folder.write("large.yaml", std::string(300'000, ' '));
  EXPECT_NE(faultOf(folder.file("large.yaml")).find("is too large"), std::string::npos);
  EXPECT_NE(faultOf("/none").find("/none: cannot be read"), std::string::npos);
}

TEST(SettingsTest, ACalibrationThatIsNoneIsRefused) {
  const std::string path = ::testing::TempDir() + "onboard_calibration.yaml";
  const std::string good = readFile(test::packageFile("config/camera_info/ardrone_front.yaml"));
  const auto isRefused = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    writeFile(path, text);
    try {
      readCalibration(path);
    } catch (const ConfigError& e) {
      return std::string(e.what()).find(path) != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(isRefused("image_width: 640", "image_width: 640"));
  EXPECT_TRUE(isRefused("image_width: 640", "image_width: wide"));
  EXPECT_TRUE(isRefused("plumb_bob", "equidistant"));
  EXPECT_TRUE(isRefused("[570, 0,", "[570,"));
  EXPECT_TRUE(isRefused("[570,", "[x,"));
  EXPECT_TRUE(isRefused("0.274, 0, 0, 0", "0.274"));
  EXPECT_TRUE(isRefused("[570,", "[-570,"));
  std::remove(path.c_str());
}

TEST(SettingsTest, TheExtrinsicsAreThoseOfTheDriversTf) {
  OnboardConfig front;
  const Eigen::Isometry3d T = extrinsicsOf(front);
  Eigen::Matrix3d forward;
  forward << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  EXPECT_TRUE(T.linear().isApprox(forward, 1e-12));
  OnboardConfig bottom;
  bottom.camera_position_m = "[0, -0.02, 0]";
  bottom.camera_rotation_deg = "[180, 0, 90]";
  EXPECT_EQ(extrinsicsOf(bottom).translation(), Eigen::Vector3d(0, -0.02, 0));
  EXPECT_TRUE((extrinsicsOf(bottom).linear() * Eigen::Vector3d::UnitZ())
                  .isApprox(-Eigen::Vector3d::UnitZ(), 1e-12))
      << "it looks down";
}

TEST(SettingsTest, SavesInFlightAtMostOnceASecondOrNotAtAll) {
  const auto autosave_s = [](const std::string& value) {
    return loadSettings("", {"mapper/autosave_s=" + value}).autosave_s;
  };
  EXPECT_EQ(autosave_s("0"), 0);
  EXPECT_EQ(autosave_s("0.001"), 1);
  EXPECT_EQ(autosave_s("30"), 30);
}

}  // namespace
}  // namespace ardrone_vslam::test
