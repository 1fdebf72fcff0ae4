// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/frame_matcher.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include "conversions/conversions.hpp"
#include "conversions/frame_names.hpp"
#include "stamps/stamp_guard.hpp"
#include "support/odometry_states.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {
namespace {

using test::odometryAt;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

FeaturesConstPtr featuresAt(std::int64_t stamp_ns) {
  auto features = boost::make_shared<Features>();
  features->header.stamp = toRosTime(stamp_ns);
  return features;
}

bool usable(const Features& /*unused*/) {
  return true;
}
bool unusable(const Features& /*unused*/) {
  return false;
}

class FrameMatcherTest : public testing::Test {
 protected:
  ImageClock clock_{0.0};
  FrameMatcher matcher_{OdometryBufferConfig{}, 0.5, clock_};
};

TEST_F(FrameMatcherTest, WaitsForTheOdometryAfterTheImage) {
  matcher_.addFeatures(featuresAt(10 * kSecond_ns), 0);
  matcher_.addOdometry(odometryAt(10 * kSecond_ns - 100, {1, 0, 0}));
  EXPECT_FALSE(matcher_.next(0.1, usable));
  matcher_.addOdometry(odometryAt(10 * kSecond_ns + 100, {3, 0, 0}));
  const auto frame = matcher_.next(0.2, usable);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->odometry.stamp_ns, 10 * kSecond_ns);
  EXPECT_NEAR(frame->odometry.T_odom_base.translation().x(), 2, 1e-12);
  EXPECT_FALSE(matcher_.next(0.2, usable));
  EXPECT_EQ(matcher_.droppedNoOdometry(), 0U);
}

TEST_F(FrameMatcherTest, TheOdometryIsThatOfTheExposure) {
  for (const double offset_s : {-0.1, 0.1}) {
    const ImageClock clock(offset_s);
    FrameMatcher matcher({}, 0.5, clock);
    const std::int64_t exposed_ns = 10 * kSecond_ns + (offset_s > 0 ? 1 : -1) * kSecond_ns / 10;
    matcher.addFeatures(featuresAt(10 * kSecond_ns), 0);
    matcher.addOdometry(odometryAt(exposed_ns - kSecond_ns / 20, {1, 0, 0}));
    // With a positive offset this is after the image's stamp, and still too early.
    EXPECT_FALSE(matcher.next(0.1, usable));
    matcher.addOdometry(odometryAt(exposed_ns + kSecond_ns / 20, {3, 0, 0}));
    const auto frame = matcher.next(0.2, usable);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->odometry.stamp_ns, exposed_ns);
    EXPECT_NEAR(frame->odometry.T_odom_base.translation().x(), 2, 1e-9);
    EXPECT_EQ(matcher.droppedNoOdometry(), 0U);
  }
}

TEST_F(FrameMatcherTest, FramesComeInOrder) {
  for (int i = 1; i <= 3; ++i) matcher_.addFeatures(featuresAt(i * kSecond_ns), 0);
  for (int i = 0; i <= 30; ++i)
    matcher_.addOdometry(odometryAt(i * kSecond_ns / 10 + 1, {1.0 * i, 0, 0}));
  for (int i = 1; i <= 2; ++i) {
    const auto frame = matcher_.next(0, usable);
    ASSERT_TRUE(frame);
    EXPECT_EQ(toNanoseconds(frame->features->header.stamp), i * kSecond_ns);
  }
}

TEST_F(FrameMatcherTest, WithoutOdometryTheWaitIsBounded) {
  matcher_.addFeatures(featuresAt(kSecond_ns), 100.0);
  EXPECT_FALSE(matcher_.next(100.5, usable));
  EXPECT_EQ(matcher_.droppedNoOdometry(), 0U);
  EXPECT_FALSE(matcher_.next(100.6, usable));
  EXPECT_EQ(matcher_.droppedNoOdometry(), 1U);
  EXPECT_EQ(matcher_.lastMiss(), OdometryBuffer::Lookup::kEmpty);
}

TEST_F(FrameMatcherTest, OdometryThatCanNeverComeIsNotWaitedFor) {
  matcher_.addOdometry(odometryAt(10 * kSecond_ns, {0, 0, 0}));
  matcher_.addOdometry(odometryAt(12 * kSecond_ns, {0, 0, 0}));
  matcher_.addFeatures(featuresAt(9 * kSecond_ns), 0);
  matcher_.addFeatures(featuresAt(11 * kSecond_ns), 0);  // in a hole of 2 s
  matcher_.addFeatures(featuresAt(12 * kSecond_ns), 0);
  const auto frame = matcher_.next(0, usable);
  ASSERT_TRUE(frame);
  EXPECT_EQ(toNanoseconds(frame->features->header.stamp), 12 * kSecond_ns);
  EXPECT_EQ(matcher_.droppedNoOdometry(), 2U);
  EXPECT_EQ(matcher_.lastMiss(), OdometryBuffer::Lookup::kGap);
}

TEST_F(FrameMatcherTest, HeldFramesWaitAsLong) {
  matcher_.addOdometry(odometryAt(kSecond_ns, {0, 0, 0}));
  matcher_.addFeatures(featuresAt(kSecond_ns), 0);
  EXPECT_FALSE(matcher_.next(0.4, unusable));
  EXPECT_EQ(matcher_.droppedHeld(), 0U);
  EXPECT_FALSE(matcher_.next(0.6, unusable));
  EXPECT_EQ(matcher_.droppedHeld(), 1U);
  matcher_.addFeatures(featuresAt(kSecond_ns), 0.6);
  EXPECT_TRUE(matcher_.next(0.7, usable));
}

TEST_F(FrameMatcherTest, ARestartForgetsTheRunBeforeWhicheverInputComesFirst) {
  matcher_.addOdometry(odometryAt(100 * kSecond_ns, {0, 0, 0}));
  matcher_.addFeatures(featuresAt(101 * kSecond_ns), 0);
  EXPECT_TRUE(matcher_.forgetAfter(2 * kSecond_ns));
  EXPECT_EQ(matcher_.droppedNoOdometry(), 1U);
  EXPECT_EQ(matcher_.addOdometry(odometryAt(kSecond_ns, {5, 0, 0})),
            OdometryBuffer::Push::kAccepted);
  EXPECT_FALSE(matcher_.forgetAfter(2 * kSecond_ns));  // the second input: nothing old is left
  matcher_.addFeatures(featuresAt(kSecond_ns), 0);
  const auto frame = matcher_.next(0, usable);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->odometry.T_odom_base.translation().x(), 5);
  EXPECT_EQ(matcher_.droppedNoOdometry(), 1U);
}

TEST(OdometryMiss, EachReasonNamesTheTopic) {
  using Lookup = OdometryBuffer::Lookup;
  std::set<std::string> sentences;
  for (const auto miss : {Lookup::kEmpty, Lookup::kNotYet, Lookup::kTooOld, Lookup::kGap}) {
    const std::string sentence = explain(miss, "/drone/odometry");
    EXPECT_NE(sentence.find("/drone/odometry"), std::string::npos);
    sentences.insert(sentence);
  }
  EXPECT_EQ(sentences.size(), 4U);
}

TEST(StampGuardTest, LateIsDroppedSeveralFarBackAreARestart) {
  using Answer = StampGuard::Answer;
  StampGuard guard;
  EXPECT_EQ(guard.check(50 * kSecond_ns), Answer::kAscending);
  EXPECT_EQ(guard.check(51 * kSecond_ns), Answer::kAscending);
  EXPECT_EQ(guard.check(51 * kSecond_ns), Answer::kNotAfter);
  EXPECT_EQ(guard.check(50 * kSecond_ns + 1), Answer::kNotAfter);
  EXPECT_EQ(guard.check(51 * kSecond_ns + 1), Answer::kAscending);  // the late one did not count
  EXPECT_EQ(guard.check(10 * kSecond_ns), Answer::kAlone);
  EXPECT_EQ(guard.check(11 * kSecond_ns), Answer::kAlone);
  EXPECT_EQ(guard.check(11 * kSecond_ns), Answer::kAlone) << "one stamp twice says no more";
  EXPECT_EQ(guard.check(12 * kSecond_ns), Answer::kRestart);
  EXPECT_EQ(guard.check(13 * kSecond_ns), Answer::kAscending);
}

TEST(StampGuardTest, SingleWrongStampsChangeNothing) {
  using Answer = StampGuard::Answer;
  StampGuard guard;
  EXPECT_EQ(guard.check(50 * kSecond_ns), Answer::kAscending);
  for (int i = 1; i < 100; ++i) {
    const std::int64_t wrong_ns = (i % 2 == 0 ? 1000 : 1) * kSecond_ns + i;
    EXPECT_EQ(guard.check(wrong_ns), Answer::kAlone);
    EXPECT_EQ(guard.check(wrong_ns + 1), Answer::kAlone) << "and two";
    EXPECT_EQ(guard.check(50 * kSecond_ns + i), Answer::kAscending);
  }
}

TEST(StampGuardTest, StampsThatDoNotAscendStrictlyAgreeAllTheSame) {
  using Answer = StampGuard::Answer;
  const std::vector<std::vector<std::int64_t>> ways_ms{
      {1, 0, 3, 2, 5},            // swapped in pairs
      {500, 0, 550, 50, 600},     // two publishers
      {0, 0, 0, 30, 30, 30, 60},  // bursts
      {0, 20'000, 40'000}};       // slower than any silence
  for (const auto& way_ms : ways_ms) {
    StampGuard guard;
    EXPECT_EQ(guard.check(1000 * kSecond_ns), Answer::kAscending) << "from the future";
    Answer last = Answer::kAscending;
    for (const std::int64_t ms : way_ms) last = guard.check(50 * kSecond_ns + ms * 1'000'000);
    EXPECT_EQ(last, Answer::kRestart) << way_ms.back();
  }
}

TEST(StampGuardTest, ALongSilenceIsNoRestart) {
  using Answer = StampGuard::Answer;
  StampGuard guard;
  EXPECT_EQ(guard.check(50 * kSecond_ns), Answer::kAscending);
  EXPECT_EQ(guard.check(53 * kSecond_ns), Answer::kAscending);
  EXPECT_EQ(guard.check(100 * kSecond_ns), Answer::kAlone);
  EXPECT_EQ(guard.check(101 * kSecond_ns), Answer::kAlone);
  EXPECT_EQ(guard.check(102 * kSecond_ns), Answer::kAscending);
}

TEST(GapCounterTest, CountsWhatIsMissing) {
  GapCounter gaps;
  for (const std::uint32_t sequence : {5U, 6U, 9U, 10U}) gaps.see(sequence);
  EXPECT_EQ(gaps.lost(), 2U);
  for (const std::uint32_t sequence : {1U, 2U}) gaps.see(sequence);  // the sender began again
  EXPECT_EQ(gaps.lost(), 2U);
  gaps.see(4);
  EXPECT_EQ(gaps.lost(), 3U);
}

TEST(GapCounterTest, NumbersThatComeRoundAreNoLoss) {
  GapCounter gaps;
  for (const std::uint32_t sequence : {0xfffffffdU, 0xffffffffU, 0U, 1U, 2U}) gaps.see(sequence);
  EXPECT_EQ(gaps.lost(), 1U) << "the one before the numbers come round";
  gaps.see(4);
  EXPECT_EQ(gaps.lost(), 2U);
}

TEST(FrameNames, TfPrefix) {
  EXPECT_EQ(withTfPrefix("", "odom"), "odom");
  EXPECT_EQ(withTfPrefix("drone", "odom"), "drone/odom");
  EXPECT_EQ(withTfPrefix("/drone", "odom"), "drone/odom");
  EXPECT_EQ(withTfPrefix("drone", "drone/odom"), "drone/odom");
  EXPECT_EQ(withTfPrefix("drone", "drone2/odom"), "drone/drone2/odom");
  EXPECT_EQ(withTfPrefix("drone", "/map"), "map");
  EXPECT_EQ(withTfPrefix("drone", ""), "");
}

TEST(WarningLimiterTest, TheSameIsSaidSeldomAnotherSoon) {
  WarningLimiter limiter;
  EXPECT_TRUE(limiter.allows("a", 0));
  EXPECT_FALSE(limiter.allows("a", 4.9));
  EXPECT_TRUE(limiter.allows("a", 5.1));
  EXPECT_FALSE(limiter.allows("b", 5.2));
  EXPECT_TRUE(limiter.allows("b", 5.4));
}

TEST(EventLimiterTest, FiveAtOnceAndFiveASecond) {
  EventLimiter limiter;
  int said = 0;
  for (int i = 0; i < 3000; ++i) said += limiter.allows(1000 + i / 30.0);
  EXPECT_LE(said, 505) << "one with each of 30 images a second, for 100 s";
  EXPECT_GE(said, 490);
  said = 0;
  for (int i = 0; i < 10; ++i) said += limiter.allows(2000);
  EXPECT_EQ(said, 5);
}

TEST(WarningsTest, EventsAndWarningsDoNotHideEachOther) {
  std::vector<std::string> said;
  Warnings warnings([&said](const std::string& sentence) { said.push_back(sentence); });
  warnings.limited("a fault");
  warnings.event("the camera changed");
  warnings.event("the map begins anew");
  warnings.limited("a fault");
  EXPECT_EQ(said,
            (std::vector<std::string>{"a fault", "the camera changed", "the map begins anew"}));
}

TEST(ReminderTest, SoonOnceThenSeldom) {
  std::vector<int> said;
  for (int second = 0; second <= 65; ++second) {
    if (isReminderDue(second)) said.push_back(second);
  }
  EXPECT_EQ(said, (std::vector<int>{3, 30, 60}));
}

}  // namespace
}  // namespace ardrone_vslam
