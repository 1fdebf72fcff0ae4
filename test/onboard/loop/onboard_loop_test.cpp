// SPDX-License-Identifier: BSD-3-Clause
#include "loop/onboard_loop.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "onboard/flight_fixture.hpp"
#include "protocol/udp.hpp"

namespace ardrone_vslam::test {
namespace {

using OnboardLoopTest = FlightFixture;

TEST_F(OnboardLoopTest, AnswersEachImageOfAFileFromAFileOfRecords) {
  writeFile(file("observer"), records());
  settings_.onboard.observer = file("observer");
  OnboardLoop loop(settings_, stop_.ends[0]);
  EXPECT_TRUE(loop.run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  for (int i = 0; i < kImages; ++i) {
    const VslamPose& pose = answers[static_cast<std::size_t>(i)];
    EXPECT_EQ(pose.flags, VSLAM_POSE_IS_VALID) << i;
    EXPECT_EQ(pose.sequence, i + 1U);
    EXPECT_EQ(pose.stamp_ns, stampOf(i));
    EXPECT_LT(pose.state, 32U);
    EXPECT_EQ(pose.observer_position_m[0], 0.5);
    EXPECT_NEAR(pose.position_m[0], 0.5, 0.1);
    EXPECT_GT(pose.deviation[0] + pose.deviation[5], 0) << i;
  }
  EXPECT_EQ(answers.back().state, static_cast<std::uint32_t>(VSLAM_ENDING));
  EXPECT_EQ(answers.back().frames_dropped, 0U);
}

TEST_F(OnboardLoopTest, AnswersSayWhatTheirImagesHadNoTimeFor) {
  writeFile(file("observer"), records());
  settings_.onboard.observer = file("observer");
  settings_.mapper.frame_budget.frame_budget_ms = 1e-3;
  OnboardLoop loop(settings_, stop_.ends[0]);
  EXPECT_TRUE(loop.run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  for (int i = 0; i < kImages; ++i) {
    EXPECT_EQ(answers[static_cast<std::size_t>(i)].flags,
              std::uint32_t{VSLAM_POSE_IS_VALID} | VSLAM_POSE_WITHOUT_KEYFRAME)
        << i;
  }
}

TEST_F(OnboardLoopTest, TakesDatagramsAndCountsTheBadOnes) {
  OnboardLoop loop(settings_, stop_.ends[0]);
  const FileDescriptor controller = sendTo({"127.0.0.1", loop.observerPort()});
  const auto send = [&](const std::string& bytes) {
    ASSERT_EQ(::write(controller.get(), bytes.data(), bytes.size()),
              static_cast<ssize_t>(bytes.size()));
  };
  const std::string good = records();
  send("noise");
  send(good.substr(0, VSLAM_OBSERVER_BYTES) + "longer");
  for (std::size_t at = 0; at < good.size(); at += VSLAM_OBSERVER_BYTES) {
    send(good.substr(at, VSLAM_OBSERVER_BYTES));
    std::string corrupted = good.substr(at, VSLAM_OBSERVER_BYTES);
    corrupted[50] = static_cast<char>(corrupted[50] ^ 4);
    send(corrupted);
  }
  send(good.substr(0, VSLAM_OBSERVER_BYTES));  // old by now
  EXPECT_TRUE(loop.run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  for (int i = 0; i < kImages; ++i)
    EXPECT_EQ(answers[static_cast<std::size_t>(i)].flags, VSLAM_POSE_IS_VALID) << i;
  EXPECT_EQ(answers.back().records_dropped, 2 + (kImages + 2U) + 1);
}

TEST_F(OnboardLoopTest, ASilentControllerIsSaidAndEachImageGivenUp) {
  OnboardLoop loop(settings_, stop_.ends[0]);
  EXPECT_TRUE(loop.run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  for (int i = 0; i < kImages; ++i) {
    const VslamPose& pose = answers[static_cast<std::size_t>(i)];
    EXPECT_EQ(pose.state, static_cast<std::uint32_t>(VSLAM_CONTROLLER_SILENT));
    EXPECT_EQ(pose.flags, 0U);
    EXPECT_EQ(pose.stamp_ns, stampOf(i));
  }
  EXPECT_EQ(answers.back().frames_dropped, static_cast<std::uint32_t>(kImages));
}

TEST_F(OnboardLoopTest, RecordsThatDoNotReachTheImagesAreSaid) {
  writeFile(file("observer"), records().substr(0, 3 * VSLAM_OBSERVER_BYTES));  // to image 1
  settings_.onboard.observer = file("observer");
  settings_.onboard.controller_silent_s = 60;
  OnboardLoop(settings_, stop_.ends[0]).run();
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  EXPECT_EQ(answers[1].flags, VSLAM_POSE_IS_VALID);
  EXPECT_EQ(answers[2].state, static_cast<std::uint32_t>(VSLAM_NO_OBSERVER));
}

TEST_F(OnboardLoopTest, ImagesThatEndWithinOneAreAFault) {
  const std::string stream = readFile(file("frames"));
  writeFile(file("frames"), stream.substr(0, stream.size() - 1));
  OnboardLoop loop(settings_, stop_.ends[0]);
  EXPECT_FALSE(loop.run());
  ASSERT_FALSE(poses().empty());
  EXPECT_EQ(poses().back().state, static_cast<std::uint32_t>(VSLAM_CAMERA_LOST));
}

TEST_F(OnboardLoopTest, AMissingCameraIsSaidUntilItIsToStop) {
  settings_.onboard.frames = "/dev/ardrone_vslam_none";
  OnboardLoop loop(settings_, stop_.ends[0]);
  bool is_good = false;
  std::thread program([&] { is_good = loop.run(); });
  while (poses().empty()) std::this_thread::yield();
  stop_.write("x");
  program.join();
  EXPECT_TRUE(is_good);
  EXPECT_EQ(poses().front().state, static_cast<std::uint32_t>(VSLAM_CAMERA_LOST));
  EXPECT_EQ(poses().back().state, static_cast<std::uint32_t>(VSLAM_ENDING));
}

TEST_F(OnboardLoopTest, AFifoOfRecordsThatStopsWithinOneHoldsNothingUp) {
  ASSERT_EQ(::mkfifo(file("observer").c_str(), 0600), 0);
  settings_.onboard.observer = file("observer");
  settings_.onboard.controller_silent_s = 60;
  const std::string good = records();
  const FileDescriptor controller(::open(file("observer").c_str(), O_RDWR));
  const std::size_t bytes = 3 * VSLAM_OBSERVER_BYTES + 70;  // to image 1, and half a record
  ASSERT_EQ(::write(controller.get(), good.data(), bytes), static_cast<ssize_t>(bytes));
  EXPECT_TRUE(OnboardLoop(settings_, stop_.ends[0]).run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  EXPECT_EQ(answers[1].flags, VSLAM_POSE_IS_VALID);
  EXPECT_EQ(answers[2].state, static_cast<std::uint32_t>(VSLAM_NO_OBSERVER));
}

TEST_F(OnboardLoopTest, AControllerMayCloseItsFifoAndComeAgain) {
  ASSERT_EQ(::mkfifo(file("observer").c_str(), 0600), 0);
  settings_.onboard.observer = file("observer");
  const std::string good = records();
  OnboardLoop loop(settings_, stop_.ends[0]);  // needs no writer
  for (std::size_t at = 0; at < good.size(); at += good.size() / 2) {
    const FileDescriptor controller(::open(file("observer").c_str(), O_WRONLY));
    ASSERT_EQ(::write(controller.get(), good.data() + at, good.size() / 2),
              static_cast<ssize_t>(good.size() / 2));
  }
  EXPECT_TRUE(loop.run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  for (int i = 0; i < kImages; ++i)
    EXPECT_EQ(answers[static_cast<std::size_t>(i)].flags, VSLAM_POSE_IS_VALID) << i;
}

TEST_F(OnboardLoopTest, AfterBytesThatAreNoRecordTheNextOneIsFound) {
  std::string bytes = records();
  bytes.insert(2 * VSLAM_OBSERVER_BYTES, "VSLnoise");
  bytes.insert(0, 1, '\0');
  writeFile(file("observer"), bytes);
  settings_.onboard.observer = file("observer");
  EXPECT_TRUE(OnboardLoop(settings_, stop_.ends[0]).run());
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  for (int i = 0; i < kImages; ++i)
    EXPECT_EQ(answers[static_cast<std::size_t>(i)].flags, VSLAM_POSE_IS_VALID) << i;
  EXPECT_GE(answers.back().records_dropped, 2U);
}

TEST_F(OnboardLoopTest, WhatCannotBeReadIsAFault) {
  settings_.onboard.frames = ::testing::TempDir();  // a folder
  OnboardLoop loop(settings_, stop_.ends[0]);
  EXPECT_FALSE(loop.run());
  EXPECT_EQ(poses().back().state, static_cast<std::uint32_t>(VSLAM_CAMERA_LOST));
}

TEST_F(OnboardLoopTest, ARecordOfADamagedTimeIsRefused) {
  VslamObserver late = odometryAt(INT64_MAX, 1);
  const Record record = recordOf(late);
  writeFile(file("observer"), std::string(record.begin(), record.end()) + records());
  settings_.onboard.observer = file("observer");
  OnboardLoop(settings_, stop_.ends[0]).run();
  const auto answers = poses();
  ASSERT_EQ(answers.size(), kImages + 1U);
  EXPECT_EQ(answers[1].flags, VSLAM_POSE_IS_VALID);
  EXPECT_EQ(answers.back().records_dropped, 1U);
}

TEST_F(OnboardLoopTest, ImagesThatStopWithinOneAreSaid) {
  const std::string stream = readFile(file("frames"));
  std::remove(file("frames").c_str());
  ASSERT_EQ(::mkfifo(file("frames").c_str(), 0600), 0);
  writeFile(file("observer"), records());
  settings_.onboard.observer = file("observer");
  settings_.onboard.every_frame = true;
  const FileDescriptor camera(::open(file("frames").c_str(), O_RDWR));
  const std::size_t half = stream.size() / (2 * kImages);
  ASSERT_EQ(::write(camera.get(), stream.data(), half), static_cast<ssize_t>(half));
  OnboardLoop loop(settings_, stop_.ends[0]);
  std::thread program([&] { loop.run(); });
  const auto isSaid = [&] {
    const auto answers = poses();
    return !answers.empty() &&
           answers.back().state == static_cast<std::uint32_t>(VSLAM_CAMERA_LOST);
  };
  while (!isSaid()) std::this_thread::yield();
  // It goes on where it was.
  for (std::size_t at = half; at < stream.size();) {
    const ssize_t written = ::write(camera.get(), stream.data() + at, stream.size() - at);
    ASSERT_GT(written, 0);
    at += static_cast<std::size_t>(written);
  }
  const auto isAnswered = [&] {
    const auto answers = poses();
    return std::any_of(answers.begin(), answers.end(), [](const VslamPose& answer) {
      return answer.stamp_ns == stampOf(kImages - 1);
    });
  };
  while (!isAnswered()) std::this_thread::yield();
  stop_.write("x");
  program.join();
}

TEST_F(OnboardLoopTest, AStampThatDoesNotAscendIsDropped) {
  writeFile(file("frames"), pgm(stampOf(1), image_) + pgm(stampOf(0), image_) +
                                pgm(stampOf(1), image_) + pgm(stampOf(2), image_));
  writeFile(file("observer"), records());
  settings_.onboard.observer = file("observer");
  OnboardLoop(settings_, stop_.ends[0]).run();
  const auto answers = poses();
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[1].stamp_ns, stampOf(2));
  EXPECT_EQ(answers.back().frames_dropped, 2U);
}

TEST_F(OnboardLoopTest, ASingleStampOfAnotherTimeDeletesNoMapAndStopsNoFlight) {
  constexpr std::int64_t kFar_ns = 1'000'000'000'000;
  writeFile(file("frames"), pgm(stampOf(0), image_) + pgm(1, image_) + pgm(stampOf(1), image_) +
                                pgm(stampOf(1) + kFar_ns, image_) + pgm(stampOf(2), image_));
  std::string observer;
  std::uint32_t sequence = 0;
  const auto add = [&](std::int64_t stamp_ns) {
    const Record record = recordOf(odometryAt(stamp_ns, ++sequence));
    observer.append(record.begin(), record.end());
  };
  for (int i = -1; i <= kImages; ++i) {
    add(stampOf(i));
    if (i == 1) {
      add(1);
      add(stampOf(i) + kFar_ns);
    }
  }
  writeFile(file("observer"), observer);
  settings_.onboard.observer = file("observer");
  OnboardLoop(settings_, stop_.ends[0]).run();
  const auto answers = poses();
  ASSERT_EQ(answers.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(answers[static_cast<std::size_t>(i)].stamp_ns, stampOf(i));
    EXPECT_NE(answers[static_cast<std::size_t>(i)].flags & VSLAM_POSE_IS_VALID, 0U) << i;
  }
  EXPECT_EQ(answers.back().frames_dropped, 2U);
  EXPECT_EQ(answers.back().records_dropped, 2U);
}

TEST_F(OnboardLoopTest, WhatCannotBeOpenedIsSaidAtOnce) {
  const auto faultWith = [&](auto OnboardConfig::*key, const auto& value) -> std::string {
    Settings wrong = settings_;
    wrong.onboard.*key = value;
    try {
      OnboardLoop(wrong, stop_.ends[0]);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(faultWith(&OnboardConfig::poses, file("none/poses")).find("none/poses"),
            std::string::npos);
  EXPECT_NE(faultWith(&OnboardConfig::observer, file("none")).find("none"), std::string::npos);
  EXPECT_NE(faultWith(&OnboardConfig::pose_address, "drone").find("drone"), std::string::npos);
  EXPECT_NE(faultWith(&OnboardConfig::camera, file("none.yaml")).find("none.yaml"),
            std::string::npos);
}

}  // namespace
}  // namespace ardrone_vslam::test
