// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_stream.hpp"

#include <gtest/gtest.h>

#include <random>

#include "onboard/flight_records.hpp"

namespace ardrone_vslam::test {
namespace {

class FrameStreamTest : public ::testing::Test {
 protected:
  using Read = FrameSource::Read;

  FrameStream stream(const FrameSize& size = {8, 4, false}, bool every_frame = true) {
    return FrameStream(FileDescriptor(pipe_.reader()), stop_.ends[0], size, every_frame);
  }
  /// What a stream of these bytes and no more is refused with.
  std::string faultOf(const std::string& bytes, const FrameSize& size = {8, 4, false}) {
    pipe_ = Pipe();
    pipe_.write(bytes);
    pipe_.close();
    FrameStream frames = stream(size);
    Frame frame;
    Read answer = frames.read(frame);
    while (answer == Read::kFrame) answer = frames.read(frame);
    return answer == Read::kLost ? frames.fault() : "";
  }

  Pipe pipe_;
  Pipe stop_;
  TestImage image_ = generatedImage(8, 4);
};

TEST_F(FrameStreamTest, GivesEachImageAndTheEnd) {
  const TestImage other = generatedImage(8, 4, 7);
  pipe_.write(pgm(100, image_) + pgm(200, other));
  pipe_.close();
  FrameStream frames = stream();
  Frame frame;
  const std::pair<int, const TestImage*> images[] = {{100, &image_}, {200, &other}};
  for (const auto& [stamp_ns, expected] : images) {
    ASSERT_EQ(frames.read(frame), Read::kFrame);
    EXPECT_EQ(frame.stamp_ns, stamp_ns);
    EXPECT_EQ(frame.image.width_px, 8);
    EXPECT_EQ(frame.image.height_px, 4);
    EXPECT_TRUE(std::equal(expected->bytes.begin(), expected->bytes.end(), frame.image.data));
  }
  EXPECT_EQ(frames.read(frame), Read::kEnd);
  EXPECT_EQ(frames.dropped(), 0U);
}

TEST_F(FrameStreamTest, TheNewestWins) {
  pipe_.write(pgm(100, image_) + pgm(200, image_) + pgm(300, image_));
  FrameStream frames = stream({8, 4, false}, false);
  Frame frame;
  ASSERT_EQ(frames.read(frame), Read::kFrame);
  EXPECT_EQ(frame.stamp_ns, 300);
  EXPECT_EQ(frames.dropped(), 2U);
  pipe_.write(pgm(400, image_));
  pipe_.close();
  ASSERT_EQ(frames.read(frame), Read::kFrame);
  EXPECT_EQ(frame.stamp_ns, 400) << "the last one before the end";
  EXPECT_EQ(frames.read(frame), Read::kEnd);
}

TEST_F(FrameStreamTest, ReadsUyvyAndHalves) {
  TestImage uyvy(32, 8);  // 16 x 8 pixels of two bytes
  for (std::size_t i = 0; i < uyvy.bytes.size(); ++i)
    uyvy.bytes[i] = static_cast<std::uint8_t>(i % 2 == 0 ? 0 : 40);
  pipe_.write("UYVY # stamp_ns 9\n16 8 255\n" + std::string(uyvy.bytes.begin(), uyvy.bytes.end()));
  FrameStream frames = stream({8, 4, true});
  Frame frame;
  ASSERT_EQ(frames.read(frame), Read::kFrame);
  EXPECT_EQ(frame.stamp_ns, 9);
  for (int i = 0; i < 32; ++i) EXPECT_EQ(frame.image.data[i], 40) << i;
}

TEST_F(FrameStreamTest, FaultsSayWhatIsWrong) {
  const std::string good = pgm(100, image_);
  EXPECT_EQ(faultOf(good), "");
  EXPECT_NE(faultOf("P6" + good.substr(2)).find("neither"), std::string::npos);
  EXPECT_NE(faultOf("UYVX" + good.substr(2)).find("neither"), std::string::npos);
  EXPECT_NE(faultOf(good, {8, 5, false}).find("8x4"), std::string::npos);
  EXPECT_NE(faultOf(good, {8, 4, true}).find("halve"), std::string::npos);
  EXPECT_NE(faultOf("P5\n8 4\n255\n" + std::string(32, 'x')).find("stamp_ns"), std::string::npos);
  EXPECT_NE(faultOf("P5\n# stamp_ns 1\n8 99999999999999999999\n").find("damaged"),
            std::string::npos);
  for (std::size_t size = 1; size < good.size(); ++size)
    EXPECT_NE(faultOf(good.substr(0, size)), "") << size << " bytes";
}

TEST_F(FrameStreamTest, NoiseIsAFaultAndNoCrash) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = pgm(100, image_) + pgm(200, image_);
    for (int flips = 0; flips < 3; ++flips)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    faultOf(bytes);
  }
}

TEST_F(FrameStreamTest, StopsWithinAnImage) {
  pipe_.write(pgm(100, image_).substr(0, 40));
  stop_.write("x");
  FrameStream frames = stream();
  Frame frame;
  EXPECT_EQ(frames.read(frame), Read::kNone);
}

}  // namespace
}  // namespace ardrone_vslam::test
