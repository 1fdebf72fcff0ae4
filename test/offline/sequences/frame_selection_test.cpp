// SPDX-License-Identifier: BSD-3-Clause
// --frames A:B:STEP and --ping-pong.

#include "sequences/sequence.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

/// Which of testImage()'s pictures it is.
int indexOf(const cv::Mat& image) {
  for (int i = 0; i < 6; ++i) {
    if (cv::norm(image, testImage(i), cv::NORM_INF) == 0) return i;
  }
  return -1;
}

std::vector<int> indicesOf(Sequence& sequence) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < sequence.size(); ++i) indices.push_back(indexOf(sequence.image(i)));
  return indices;
}

std::unique_ptr<Sequence> openSelected(const TemporaryFolder& folder, const std::string& frames,
                                       bool ping_pong) {
  return select(openFolder(folder.path()), FrameSelection::parse(frames, ping_pong));
}

using Indices = std::vector<int>;

TEST(FrameSelection, ParsesEveryPartOrNone) {
  const auto all = FrameSelection::parse("", true);
  EXPECT_EQ(all.begin, 0u);
  EXPECT_FALSE(all.end.has_value());
  EXPECT_EQ(all.step, 1u);
  EXPECT_TRUE(all.ping_pong);
  const auto full = FrameSelection::parse("3:20:2", false);
  EXPECT_EQ(full.begin, 3u);
  EXPECT_EQ(full.end.value_or(0), 20u);
  EXPECT_EQ(full.step, 2u);
  EXPECT_FALSE(full.ping_pong);
  EXPECT_EQ(FrameSelection::parse("::4", false).step, 4u);
  EXPECT_EQ(FrameSelection::parse("7:", false).begin, 7u);
  EXPECT_EQ(FrameSelection::parse(":9", false).end.value_or(0), 9u);
}

TEST(FrameSelection, SaysWhatIsWrong) {
  const auto parse = [](const std::string& text) {
    return [text] { FrameSelection::parse(text, false); };
  };
  expectError(parse("5"), {"'5'", "A:B:STEP"});
  expectError(parse("1:2:3:4"), {"A:B:STEP"});
  expectError(parse("a:2"), {"'a' is not a whole number"});
  expectError(parse("-1:2"), {"'-1' is not a whole number"});
  expectError(parse("1:2:0"), {"step must be at least 1"});
  expectError(parse("4:4"), {"must be larger than the begin"});
  EXPECT_THROW(FrameSelection::parse("5", false), std::invalid_argument);
}

TEST(FrameSelection, TakesFramesWithTheirStamps) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 6);
  const auto sequence = openSelected(folder, "1:6:2", false);
  EXPECT_EQ(indicesOf(*sequence), (Indices{1, 3, 5}));
  EXPECT_EQ(sequence->stamp_ns(0), 100'000'000);
  EXPECT_EQ(sequence->stamp_ns(2), 500'000'000);
  EXPECT_EQ(indicesOf(*openSelected(folder, "4:99", false)), (Indices{4, 5}));
  EXPECT_EQ(indicesOf(*openSelected(folder, "", false)), (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(openSelected(folder, "0:6:18446744073709551615", false)->size(), 1u);
  expectError([&] { openSelected(folder, "6:", false); }, {"6 frames", "begins at frame 6"});
  expectError([&] { openSelected(folder, "5:", true); }, {"ping-pong", "two"});
}

TEST(FrameSelection, CutsTruthAndOdometryToTheFrames) {
  TemporaryFolder folder;
  makeTumFolder(folder, 5);  // poses at 0, 0.2, 0.4 s
  folder.write("odometry_tum.txt",
               "-1.2 0 0 0 0 0 0 1\n-0.5 1 0 0 0 0 0 1\n0.3 2 0 0 0 0 0 1\n2 3 0 0 0 0 0 1\n");
  const auto sequence = openSelected(folder, "1:4", false);  // 0.1 to 0.3 s
  const auto& poses = sequence->truth().poses();
  ASSERT_EQ(poses.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(poses[i].stamp_ns, sequence->stamp_ns(i));
    EXPECT_NEAR(poses[i].T_frame_body.translation().x(), 0.1 + 0.1 * static_cast<double>(i), 1e-9);
  }
  ASSERT_EQ(sequence->odometry().size(), 2u);
  EXPECT_EQ(sequence->odometry()[0].T_odom_base.translation().x(), 1);
}

TEST(FrameSelection, PingPongGoesThereOnEvenAndBackOnOddFrames) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 6);
  EXPECT_EQ(indicesOf(*openSelected(folder, "", true)), (Indices{0, 2, 4, 5, 3, 1}));
  EXPECT_EQ(indicesOf(*openSelected(folder, ":5", true)), (Indices{0, 2, 4, 3, 1}));
  EXPECT_EQ(indicesOf(*openSelected(folder, "1:", true)), (Indices{1, 3, 5, 4, 2}));
  EXPECT_EQ(indicesOf(*openSelected(folder, "::3", true)), (Indices{0, 3}));
}

TEST(FrameSelection, PingPongStampsAscendAndTruthFollowsTheImages) {
  TemporaryFolder folder;
  makeKittiFolder(folder, 6);
  folder.write("times.txt", "7.0\n7.1\n7.2\n7.3\n7.6\n7.7\n");  // one hole; the median is 0.1 s
  const auto original = openFolder(folder.path());
  const auto sequence = openSelected(folder, "", true);
  const std::size_t order[] = {0, 2, 4, 5, 3, 1};
  ASSERT_EQ(sequence->truth().size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(sequence->stamp_ns(i), 7'000'000'000 + static_cast<std::int64_t>(i) * 100'000'000);
    const StampedPose& pose = sequence->truth().poses()[i];
    EXPECT_EQ(pose.stamp_ns, sequence->stamp_ns(i));
    EXPECT_TRUE(
        pose.T_frame_body.isApprox(original->truth().poses()[order[i]].T_frame_body, 1e-12));
  }
}

TEST(FrameSelection, PingPongDropsTheRecordedOdometry) {
  TemporaryFolder folder;
  makeTumFolder(folder, 4);
  folder.write("odometry_tum.txt", "0 0 0 0 0 0 0 1\n0.3 1 0 0 0 0 0 1\n");
  EXPECT_EQ(openSelected(folder, "", false)->odometry().size(), 2u);
  EXPECT_TRUE(openSelected(folder, "", true)->odometry().empty());
}

}  // namespace
}  // namespace ardrone_vslam
