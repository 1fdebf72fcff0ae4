// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/frame_budget.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace ardrone_vslam {
namespace {

/// Images whose works take what is said; what was there no time for.
class BudgetedImages {
 public:
  explicit BudgetedImages(double budget_ms) : budget_(budget_ms) {}

  LeftOut image(double before_ms, const std::array<double, 3>& works_ms) {
    now_ms_ = before_ms;
    budget_.begin([this] { return now_ms_; });
    for (const OptionalWork work :
         {OptionalWork::kPlaceSearch, OptionalWork::kLandmarks, OptionalWork::kKeyframe}) {
      if (!budget_.take(work)) continue;
      now_ms_ += works_ms[static_cast<std::size_t>(work)];
      budget_.done(work);
    }
    return budget_.leftOut();
  }
  double took_ms() const { return now_ms_; }

 private:
  FrameBudget budget_;
  double now_ms_ = 0;
};

constexpr std::array<double, 3> kWorks_ms{10, 20, 30};

TEST(FrameBudget, WithoutBoundOrClockAllIsDone) {
  BudgetedImages without_bound(0);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(without_bound.image(1e6, kWorks_ms).none());
  FrameBudget without_clock(1e-3);
  without_clock.begin({});
  EXPECT_TRUE(without_clock.take(OptionalWork::kKeyframe));
}

TEST(FrameBudget, WhatCountsLeastGoesFirst) {
  BudgetedImages images(60);
  EXPECT_TRUE(images.image(0, kWorks_ms).none());
  EXPECT_TRUE(images.image(0, kWorks_ms).none()) << "it fits exactly";
  EXPECT_EQ(images.image(5, kWorks_ms), LeftOut("001")) << "place search alone";
  EXPECT_EQ(images.image(15, kWorks_ms), LeftOut("011")) << "and landmarks";
  EXPECT_EQ(images.image(35, kWorks_ms), LeftOut("111")) << "and the keyframe";
}

TEST(FrameBudget, AWorkThatIsTooLongComesBackNowAndThen) {
  BudgetedImages images(20);
  std::vector<int> done;
  for (int i = 0; i < 31; ++i) {
    if (!images.image(0, {0, 0, 40})[2]) done.push_back(i);
  }
  // Less than half of 40 is asked for after 12 images without it.
  EXPECT_EQ(done, (std::vector<int>{0, 12, 24}));
}

TEST(FrameBudget, AWorkThatIsNotDueDoesNotShutOthersOut) {
  double now_ms = 0;
  FrameBudget budget(50);
  const auto image = [&] {
    now_ms = 0;
    budget.begin([&] { return now_ms; });
  };
  image();
  ASSERT_TRUE(budget.take(OptionalWork::kKeyframe));
  now_ms = 80;
  budget.done(OptionalWork::kKeyframe);
  int without_landmarks = 0;
  for (int i = 0; i < 100; ++i) {  // at rest no keyframe is due
    image();
    if (budget.take(OptionalWork::kLandmarks)) {
      now_ms = 5;
      budget.done(OptionalWork::kLandmarks);
    } else {
      ++without_landmarks;
    }
  }
  EXPECT_GT(without_landmarks, 0);
  EXPECT_LT(without_landmarks, 15);
}

TEST(FrameBudget, ALongOneIsRememberedForAWhile) {
  BudgetedImages images(50);
  images.image(0, {0, 0, 40});
  for (int i = 0; i < 3; ++i) images.image(0, {0, 0, 1});
  EXPECT_TRUE(images.image(21, {0, 0, 1})[2]) << "40 ms three images ago";
  for (int i = 0; i < 10; ++i) images.image(0, {0, 0, 1});
  EXPECT_FALSE(images.image(21, {0, 0, 1})[2]);
}

TEST(FrameBudget, NoImageTakesLongerWhileWorksTakeWhatTheyTook) {
  BudgetedImages images(45);
  images.image(0, kWorks_ms);  // what works take is not known yet
  std::array<int, 3> left_out{};
  for (int i = 0; i < 100; ++i) {
    const LeftOut of_image = images.image(i % 7, kWorks_ms);
    EXPECT_LE(images.took_ms(), 45);
    for (std::size_t work = 0; work < left_out.size(); ++work) left_out[work] += of_image[work];
  }
  EXPECT_LE(left_out[2], 100 / 7) << "when landmarks come back the keyframe waits for an image";
  EXPECT_LE(left_out[1], 90);
  EXPECT_LE(left_out[0], 95);
}

}  // namespace
}  // namespace ardrone_vslam
