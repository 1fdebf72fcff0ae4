// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_streams.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "doctor/camera/doctor_tracks.hpp"
#include "doctor/doctor_examination.hpp"
#include "doctor/recording/doctor_topics.hpp"
#include "support/doctor_findings.hpp"
#include "support/doctor_recordings.hpp"

namespace ardrone_vslam {
namespace {

using test::findingOf;
using test::goodRecording;
using test::verdictOf;

constexpr std::int64_t kMillisecond_ns = 1'000'000;

TEST(DoctorStreams, SoundStampsHaveNoFault) {
  const DoctorRecording good = goodRecording();
  for (const Finding& finding : checkImageStream(good)) EXPECT_EQ(finding.verdict, Verdict::kOk);
  for (const Finding& finding : checkOdometryStream(good)) EXPECT_EQ(finding.verdict, Verdict::kOk);
  EXPECT_EQ(findingOf(checkImageStream(good), "image_rate").text, "10.0 Hz for 11.9 s");
  EXPECT_EQ(checkClock(good).verdict, Verdict::kOk);
  EXPECT_EQ(checkTopics(good).verdict, Verdict::kOk);
}

TEST(DoctorStreams, FindsGapsAndSlowImages) {
  DoctorRecording gap = goodRecording();
  for (std::size_t i = 60; i < 120; ++i) gap.images[i].time.stamp_ns += 2000 * kMillisecond_ns;
  EXPECT_EQ(verdictOf(checkImageStream(gap), "image_rate"), Verdict::kWarning);
  DoctorRecording slow = goodRecording();
  for (std::size_t i = 0; i < 120; ++i) {
    slow.images[i].time.stamp_ns = test::doctorStamp_ns(0.5 * static_cast<double>(i));
  }
  EXPECT_EQ(verdictOf(checkImageStream(slow), "image_rate"), Verdict::kWarning);
  slow.images.resize(1);
  EXPECT_EQ(verdictOf(checkImageStream(slow), "image_rate"), Verdict::kFault);
  slow.images.clear();
  EXPECT_EQ(verdictOf(checkImageStream(slow), "image_rate"), Verdict::kFault);
}

TEST(DoctorStreams, FindsStampsThatAreMissingGoBackOrBeginAnew) {
  DoctorRecording back = goodRecording();
  back.images[50].time.stamp_ns = back.images[48].time.stamp_ns;
  EXPECT_EQ(verdictOf(checkImageStream(back), "image_stamps"), Verdict::kWarning);
  DoctorRecording loop = goodRecording();
  loop.images.insert(loop.images.end(), loop.images.begin(), loop.images.begin() + 50);
  EXPECT_NE(findingOf(checkImageStream(loop), "image_stamps").text.find("began anew"),
            std::string::npos);
  DoctorRecording none = goodRecording();
  for (DoctorImage& image : none.images) image.time.stamp_ns = 0;
  EXPECT_EQ(verdictOf(checkImageStream(none), "image_stamps"), Verdict::kFault);
}

TEST(DoctorStreams, FindsBursts) {
  DoctorRecording bursts = goodRecording();
  for (std::size_t i = 0; i < 1200; ++i) {
    bursts.odometry[i].time.stamp_ns = bursts.odometry[i - i % 6].time.stamp_ns;
  }
  const Finding finding = findingOf(checkOdometryStream(bursts), "odometry_bursts");
  EXPECT_EQ(finding.verdict, Verdict::kWarning);
  EXPECT_NE(finding.text.find("up to 6"), std::string::npos) << finding.text;
}

TEST(DoctorStreams, FindsAnotherClock) {
  DoctorRecording far = goodRecording();
  for (DoctorImage& image : far.images) image.time.stamp_ns += 3600 * 1000 * kMillisecond_ns;
  EXPECT_EQ(checkClock(far).verdict, Verdict::kFault);
  DoctorRecording late = goodRecording();
  for (DoctorImage& image : late.images) image.time.received_ns += 500 * kMillisecond_ns;
  EXPECT_EQ(checkClock(late).verdict, Verdict::kWarning);
  DoctorRecording future = goodRecording();
  for (DoctorImage& image : future.images) image.time.received_ns -= 100 * kMillisecond_ns;
  EXPECT_EQ(checkClock(future).verdict, Verdict::kWarning);
  // A bag that was played and recorded again: all stamps are as old.
  DoctorRecording old = goodRecording();
  for (DoctorImage& image : old.images) image.time.received_ns += 1'000'000 * kMillisecond_ns;
  for (auto& odometry : old.odometry) odometry.time.received_ns += 1'000'000 * kMillisecond_ns;
  EXPECT_EQ(checkClock(old).verdict, Verdict::kOk);
}

TEST(DoctorStreams, FindsImagesThatCannotBeUsed) {
  DoctorRecording some = goodRecording();
  some.images[3].fault = "cut off";
  EXPECT_EQ(verdictOf(checkImageStream(some), "image_format"), Verdict::kWarning);
  for (DoctorImage& image : some.images) image.fault = "cut off";
  EXPECT_EQ(verdictOf(checkImageStream(some), "image_format"), Verdict::kFault);
}

TEST(DoctorTopics, TakesTheTopicWithMostMessagesThenTheShortestName) {
  DoctorRecording drone;
  drone.topics = {{"/ardrone/image_raw", {"sensor_msgs/Image", 30}},
                  {"/ardrone/image_raw/compressed", {"sensor_msgs/CompressedImage", 40}},
                  {"/ardrone/bottom/image_raw", {"sensor_msgs/Image", 10}},
                  {"/ardrone/front/image_raw", {"sensor_msgs/Image", 30}},
                  {"/ardrone/camera_info", {"sensor_msgs/CameraInfo", 30}},
                  {"/ardrone/front/camera_info", {"sensor_msgs/CameraInfo", 30}},
                  {"/ardrone/odometry", {"nav_msgs/Odometry", 100}},
                  {"/vslam/odometry_fused", {"nav_msgs/Odometry", 200}},
                  {"/ardrone/navdata", {"ardrone_autonomy/Navdata", 100}}};
  chooseTopics({}, drone);
  EXPECT_EQ(drone.image_topic, "/ardrone/image_raw");
  EXPECT_EQ(drone.camera_info_topic, "/ardrone/camera_info");
  EXPECT_EQ(drone.odometry_topic, "/ardrone/odometry");
  EXPECT_EQ(drone.navdata_topic, "/ardrone/navdata");
  EXPECT_FALSE(drone.choices.empty());
  chooseTopics({"ardrone/front/image_raw", "", "", "", ""}, drone);
  EXPECT_EQ(drone.image_topic, "/ardrone/front/image_raw");
  EXPECT_EQ(drone.camera_info_topic, "/ardrone/front/camera_info");
  EXPECT_THROW(chooseTopics({"/none", "", "", "", ""}, drone), std::runtime_error);
  EXPECT_THROW(chooseTopics({"/ardrone/odometry", "", "", "", ""}, drone), std::runtime_error);
}

TEST(DoctorTopics, TellReplayWhatWasChosenAmongSeveral) {
  DoctorRecording one;
  one.topics = {{"/cam/image_raw", {"sensor_msgs/Image", 30}},
                {"/cam/camera_info", {"sensor_msgs/CameraInfo", 30}},
                {"/odom", {"nav_msgs/Odometry", 100}},
                {"/vslam/observer_odometry", {"nav_msgs/Odometry", 200}}};
  chooseTopics({}, one);
  EXPECT_EQ(one.odometry_topic, "/odom");  // not what was recorded of this package's own
  EXPECT_EQ(one.replay_options, std::vector<std::string>{});
  DoctorRecording several = one;
  several.topics["/ardrone/front/image_raw"] = {"sensor_msgs/Image", 40};
  several.topics["/ardrone/imu"] = {"sensor_msgs/Imu", 100};
  several.topics["/imu"] = {"sensor_msgs/Imu", 300};
  several.topics["/wheels"] = {"nav_msgs/Odometry", 90};
  several.topics["/ardrone/navdata"] = {"ardrone_autonomy/Navdata", 100};
  chooseTopics({}, several);
  EXPECT_EQ(several.replay_options,
            (std::vector<std::string>{"--image-topic /ardrone/front/image_raw",
                                      "--odometry-topic /odom"}));
  DoctorTopicNames names;
  names.odometry = "wheels";
  chooseTopics(names, several);
  EXPECT_EQ(several.replay_options.back(), "--odometry-topic /wheels");
  // Without odometry navdata is the odometry, and its IMU the one beside it.
  several.topics.erase("/odom");
  several.topics.erase("/wheels");
  several.topics["/joy"] = {"geometry_msgs/Twist", 500};
  several.topics["/cmd_vel"] = {"geometry_msgs/Twist", 20};
  chooseTopics({}, several);
  EXPECT_EQ(several.odometry_topic, "");
  EXPECT_EQ(several.imu_topic, "/ardrone/imu");
  EXPECT_EQ(several.replay_options,
            (std::vector<std::string>{"--image-topic /ardrone/front/image_raw",
                                      "--imu-topic /ardrone/imu", "--command-topic /cmd_vel"}));
}

TEST(DoctorTracks, LooksAtStretchesOfALongRecording) {
  EXPECT_EQ(imagesToTrack(5).size(), 5U);
  const auto chosen = imagesToTrack(10000, 900);
  ASSERT_EQ(chosen.size(), 900U);
  EXPECT_EQ(chosen.front(), 0U);
  EXPECT_EQ(chosen.back(), 9999U);
  for (std::size_t i = 1; i < chosen.size(); ++i) EXPECT_LT(chosen[i - 1], chosen[i]);
  EXPECT_EQ(chosen[89], 89U);  // on end
}

TEST(DoctorExamination, NamesWhatIsMissingAndSaysNotCheckedForTheRest) {
  const DoctorReport report = examine(DoctorRecording(), {});
  EXPECT_FALSE(report.canWork());
  for (const Finding& finding : report.findings) {
    const bool is_topics = finding.check == "topics";
    EXPECT_EQ(finding.verdict, is_topics ? Verdict::kFault : Verdict::kNotChecked)
        << finding.check << ": " << finding.text;
  }
  for (auto topic : {&DoctorRecording::image_topic, &DoctorRecording::camera_info_topic,
                     &DoctorRecording::odometry_topic}) {
    DoctorRecording recording = goodRecording();
    (recording.*topic).clear();
    EXPECT_FALSE(examine(recording, {}).canWork());
  }
}

TEST(DoctorReport, TellsVerdictRemedyAndParameters) {
  DoctorReport report;
  report.name = "a.bag";
  report.findings = {{"lens", Verdict::kWarning, "folds", "calibrate"},
                     {"clock", Verdict::kNotChecked, "because", {}}};
  report.parameters = {{"mapper", "odometry_mode", "twist", "mirrored"}};
  EXPECT_TRUE(report.canWork());
  const std::string text = textOf(report);
  for (const std::string part :
       {"warning      lens", "-> calibrate", "not checked  clock",
        "mapper:\n  odometry_mode: twist  # mirrored", "a.bag: usable (0 faults, 1 warnings"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in " << text;
  }
  const auto json = jsonOf(report);
  EXPECT_TRUE(json["usable"].get<bool>());
  EXPECT_EQ(json["checks"][0]["verdict"], "warning");
  EXPECT_EQ(json["parameters"]["mapper/odometry_mode"]["value"], "twist");
  report.findings.push_back({"camera_tf", Verdict::kFault, "none", {}});
  EXPECT_FALSE(report.canWork());
}

}  // namespace
}  // namespace ardrone_vslam
