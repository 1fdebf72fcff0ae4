// SPDX-License-Identifier: BSD-3-Clause
#include "images/image_queue.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <thread>
#include <vector>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kCapacity = 3;

template <class Message>
boost::shared_ptr<const Message> stamped(int stamp_s) {
  auto message = boost::make_shared<Message>();
  message->header.stamp = ros::Time(stamp_s);
  return message;
}

sensor_msgs::ImageConstPtr imageAt(int stamp_s) {
  return stamped<sensor_msgs::Image>(stamp_s);
}

sensor_msgs::CameraInfoConstPtr infoAt(int stamp_s) {
  return stamped<sensor_msgs::CameraInfo>(stamp_s);
}

class ImageQueueTest : public testing::Test {
 protected:
  void addImages(const std::vector<int>& stamps_s) {
    for (const int stamp_s : stamps_s) queue_.addImage({imageAt(stamp_s), nullptr});
  }
  void addInfos(const std::vector<int>& stamps_s) {
    for (const int stamp_s : stamps_s) queue_.addInfo(infoAt(stamp_s));
  }
  void addPairs(const std::vector<int>& stamps_s) {
    for (const int stamp_s : stamps_s) {
      addImages({stamp_s});
      addInfos({stamp_s});
    }
  }
  /// Takes all pairs out. @return their stamps
  std::vector<int> takeAll() {
    std::vector<int> stamps_s;
    bool has_more = false;
    while (const auto pair = queue_.take(has_more)) {
      EXPECT_EQ(pair->image.header().stamp, pair->info->header.stamp);
      stamps_s.push_back(static_cast<int>(pair->info->header.stamp.sec));
      ++taken_;
    }
    return stamps_s;
  }
  void TearDown() override {
    const auto counts = queue_.counts();
    EXPECT_EQ(counts.images, taken_ + counts.overflowed + counts.without_info + counts.waiting);
  }

  ImageQueue queue_{kCapacity};
  std::uint64_t taken_ = 0;
};

TEST_F(ImageQueueTest, PairsAreOfEqualStampsInWhateverOrderTheyCome) {
  addImages({1, 2});
  addInfos({1, 2, 3, 4});
  EXPECT_EQ(takeAll(), (std::vector<int>{1, 2}));
  addImages({3, 4});
  EXPECT_EQ(takeAll(), (std::vector<int>{3, 4}));
  EXPECT_EQ(queue_.counts().paired, 4U);
}

TEST_F(ImageQueueTest, InfosMayComeLongBeforeTheImages) {
  for (int i = 1; i <= 100; ++i) addInfos({i});
  for (int i = 1; i <= 100; ++i) {
    addImages({i});
    EXPECT_EQ(takeAll(), std::vector<int>{i});
  }
}

TEST_F(ImageQueueTest, TheNewestAreKeptAndTheLossIsCounted) {
  addPairs({1, 2, 3, 4, 5});
  EXPECT_EQ(queue_.counts().overflowed, 2U);
  EXPECT_EQ(takeAll(), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(queue_.counts().without_info, 0U);
}

TEST_F(ImageQueueTest, ImagesBeforeTheFirstInfoAreCountedApart) {
  addImages({1, 2, 3, 4, 5});
  EXPECT_EQ(queue_.counts().without_info, 2U) << "three may still get theirs";
  EXPECT_EQ(queue_.counts().waiting, 3U);
  addInfos({5});
  EXPECT_EQ(queue_.counts().without_info, 4U) << "infos come in order";
  EXPECT_EQ(queue_.counts().overflowed, 0U);
  EXPECT_EQ(takeAll(), std::vector<int>{5});
}

TEST_F(ImageQueueTest, AnImageWithAStampOfItsOwnIsCountedWhicheverOfTheNextPairComesFirst) {
  addPairs({1});
  addImages({7});  // no camera_info has this stamp
  addInfos({2, 3});
  addImages({3});
  EXPECT_EQ(queue_.counts().without_info, 1U);
  addImages({8, 4});
  addInfos({4});
  EXPECT_EQ(queue_.counts().without_info, 2U);
  EXPECT_EQ(queue_.counts().waiting, 3U) << "the pairs";
  EXPECT_EQ(takeAll(), (std::vector<int>{1, 3, 4}));
}

TEST_F(ImageQueueTest, AnInfoThatComesTooLateShowsThatTheImageWasInTheWay) {
  addImages({1, 2, 3, 4, 5});
  addInfos({2, 3, 4, 5});
  EXPECT_EQ(queue_.counts().without_info, 1U) << "the first image's never came";
  EXPECT_EQ(queue_.counts().overflowed, 1U);
  EXPECT_EQ(takeAll(), (std::vector<int>{3, 4, 5}));
}

TEST_F(ImageQueueTest, InfosWithoutImageAreNoLoss) {
  addInfos({1, 2, 3});
  addPairs({4});
  EXPECT_EQ(takeAll(), std::vector<int>{4});
  EXPECT_EQ(queue_.counts().infos, 4U);
  EXPECT_EQ(queue_.counts().waiting + queue_.counts().without_info + queue_.counts().overflowed,
            0U);
}

TEST_F(ImageQueueTest, ImagesThatShareAStampAreNotLostUnseen) {
  addImages({0, 0});
  addInfos({0, 0});
  EXPECT_EQ(takeAll(), (std::vector<int>{0, 0}));
}

TEST_F(ImageQueueTest, TimeMayBeginAgain) {
  addPairs({7, 8});
  addPairs({1});
  EXPECT_EQ(takeAll(), (std::vector<int>{7, 8, 1}));
}

TEST_F(ImageQueueTest, KeepsTheMessageItself) {
  const auto image = imageAt(1);
  queue_.addImage({image, nullptr});
  addInfos({1});
  bool has_more = false;
  const auto pair = queue_.take(has_more);
  ++taken_;
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->image.raw, image);
}

TEST_F(ImageQueueTest, CompressedImages) {
  queue_.addImage({nullptr, stamped<sensor_msgs::CompressedImage>(1)});
  addInfos({1});
  EXPECT_EQ(takeAll(), std::vector<int>{1});
}

TEST_F(ImageQueueTest, WakesOncePerBacklog) {
  bool has_more = true;
  EXPECT_FALSE(queue_.addImage({imageAt(1), nullptr}));
  EXPECT_TRUE(queue_.addInfo(infoAt(1))) << "the first pair";
  queue_.addImage({imageAt(2), nullptr});
  EXPECT_FALSE(queue_.addInfo(infoAt(2))) << "the worker is on its way";
  queue_.take(has_more);
  EXPECT_TRUE(has_more);
  queue_.take(has_more);
  EXPECT_FALSE(has_more);
  EXPECT_FALSE(queue_.take(has_more));
  EXPECT_FALSE(has_more);
  queue_.addInfo(infoAt(3));
  EXPECT_TRUE(queue_.addImage({imageAt(3), nullptr}));
  queue_.take(has_more);
  taken_ = 3;
}

TEST(ImageQueue, NothingIsLostUnseenBetweenTwoThreads) {
  constexpr int kImages = 20000;
  ImageQueue queue(kCapacity);
  std::thread receiver([&queue] {
    for (int i = 1; i <= kImages; ++i) {
      queue.addImage({imageAt(i), nullptr});
      queue.addInfo(infoAt(i));
    }
  });
  std::uint64_t taken = 0;
  std::uint32_t newest_s = 0;
  while (newest_s < kImages) {  // the newest is never the one that goes
    bool has_more = false;
    const auto pair = queue.take(has_more);
    if (!pair) continue;
    ++taken;
    ASSERT_GT(pair->info->header.stamp.sec, newest_s);
    newest_s = pair->info->header.stamp.sec;
  }
  receiver.join();
  EXPECT_EQ(queue.counts().images, static_cast<std::uint64_t>(kImages));
  EXPECT_EQ(taken + queue.counts().overflowed, static_cast<std::uint64_t>(kImages));
}

}  // namespace
}  // namespace ardrone_vslam
