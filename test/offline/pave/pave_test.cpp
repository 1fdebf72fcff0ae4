// SPDX-License-Identifier: BSD-3-Clause
// The AR.Drone's video stream: whole, damaged, and as a sequence.

#include "pave/pave.hpp"

#include <algorithm>
#include <iterator>

#include "pave/pave_sequence.hpp"
#include "simulation/random_source.hpp"
#include "support/pave_packets.hpp"
#include "support/real_data.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

using test::realData;

PaveStream parse(const Bytes& bytes) {
  return parsePave(bytes.data(), bytes.size());
}

std::vector<std::uint32_t> numbersOf(const PaveStream& stream) {
  std::vector<std::uint32_t> numbers;
  for (const auto& frame : stream.frames) numbers.push_back(frame.header.frame_number);
  return numbers;
}

using Numbers = std::vector<std::uint32_t>;

TEST(Pave, ReadsTheHeader) {
  Packet packet = idr(70000);
  packet.slices = 2;
  packet.slice = 1;
  const Bytes bytes = toBytes(packet);
  const auto header = parsePaveHeader(bytes.data(), bytes.size());
  ASSERT_TRUE(header.has_value());
  EXPECT_EQ(header->header_size_bytes, 68u);
  EXPECT_EQ(header->payload_size_bytes, 20u);
  EXPECT_EQ(header->codec, 4);
  EXPECT_EQ(header->width_px, 640);
  EXPECT_EQ(header->height_px, 360);
  EXPECT_EQ(header->frame_number, 70000u);
  EXPECT_EQ(header->timestamp_ms, 1000u + 33u * 70000u);
  EXPECT_EQ(header->frame_type, PaveHeader::kIdr);
  EXPECT_EQ(header->slice_count, 2);
  EXPECT_EQ(header->slice_index, 1);
  EXPECT_FALSE(parsePaveHeader(bytes.data(), 63).has_value());
  EXPECT_FALSE(parsePaveHeader(bytes.data() + 1, bytes.size() - 1).has_value());
}

TEST(Pave, WholeStream) {
  const auto stream = parse(join({toBytes(idr(1)), toBytes(dependent(2)), toBytes(idr(3))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 2, 3}));
  EXPECT_EQ(stream.frames[1].payload, Bytes(20, 2));
  EXPECT_EQ(stream.statistics.packets, 3u);
  EXPECT_EQ(stream.statistics.broken_packets, 0u);
  EXPECT_EQ(stream.statistics.garbage_bytes, 0u);
  EXPECT_EQ(stream.statistics.lost_frames, 0u);
}

TEST(Pave, LooksForTheNextHeaderBehindGarbage) {
  const Bytes garbage(37, 0x50);  // 'P'
  const auto stream = parse(join({garbage, toBytes(idr(1)), toBytes(dependent(2)), garbage,
                                  toBytes(idr(3)), toBytes(dependent(4))}));
  // Whether the garbage came behind frame 2 or into it cannot be told.
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 3, 4}));
  EXPECT_EQ(stream.statistics.garbage_bytes, 2 * 37u);
  EXPECT_EQ(stream.statistics.broken_packets, 1u);
}

TEST(Pave, ResumesAtAnIdrPictureBehindLostBytes) {
  Bytes cut = toBytes(dependent(2));
  cut.resize(cut.size() - 5);
  const auto stream = parse(join({toBytes(idr(1)), cut, toBytes(dependent(3)),
                                  toBytes(dependent(4)), toBytes(idr(5)), toBytes(dependent(6))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 5, 6}));
  EXPECT_EQ(stream.statistics.broken_packets, 1u);
  EXPECT_EQ(stream.statistics.lost_frames, 1u);
  EXPECT_EQ(stream.statistics.waiting_frames, 2u);
}

TEST(Pave, HoleInTheNumbersAndStartWithoutIdr) {
  const auto stream =
      parse(join({toBytes(dependent(8)), toBytes(dependent(9)), toBytes(idr(10)),
                  toBytes(dependent(14)), toBytes(dependent(15)), toBytes(idr(16))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{10, 16}));
  EXPECT_EQ(stream.statistics.lost_frames, 3u);
  EXPECT_EQ(stream.statistics.waiting_frames, 4u);
}

TEST(Pave, RepeatedAndOlderFramesAreDropped) {
  const auto stream = parse(join({toBytes(idr(1)), toBytes(dependent(2)), toBytes(dependent(2)),
                                  toBytes(dependent(1)), toBytes(dependent(3))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 2, 3}));
  EXPECT_EQ(stream.statistics.misordered_frames, 2u);
}

TEST(Pave, ARestartedDroneCountsAnew) {
  const auto stream = parse(
      join({toBytes(idr(500)), toBytes(dependent(501)), toBytes(idr(1)), toBytes(dependent(2))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{500, 501, 1, 2}));
  EXPECT_EQ(stream.statistics.misordered_frames, 0u);
}

TEST(Pave, JoinsSlicesAndParameterSets) {
  Packet headers = dependent(1);
  headers.type = PaveHeader::kHeaders;
  headers.fill = 99;
  headers.payload_bytes = 4;
  Packet first = idr(1);
  first.slices = 2;
  Packet second = first;
  second.slice = 1;
  second.fill = 77;
  const auto stream =
      parse(join({toBytes(headers), toBytes(first), toBytes(second), toBytes(dependent(2))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 2}));
  EXPECT_EQ(stream.frames[0].payload, join({Bytes(4, 99), Bytes(20, 1), Bytes(20, 77)}));
  EXPECT_EQ(stream.statistics.misordered_frames, 0u);
}

TEST(Pave, OtherSizeAndCodecAreLeftOut) {
  Packet other_size = idr(2);
  other_size.width_px = 320;
  Packet other_codec = idr(4);
  other_codec.codec = 2;
  const auto stream = parse(join({toBytes(idr(1)), toBytes(other_size), toBytes(dependent(3)),
                                  toBytes(other_codec), toBytes(idr(5))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 5}));
  EXPECT_EQ(stream.statistics.other_size_frames, 1u);
  EXPECT_EQ(stream.statistics.waiting_frames, 1u);
  EXPECT_EQ(stream.statistics.broken_packets, 1u);
}

TEST(Pave, ADamagedSizeOfTheFirstPacketCostsItsGroupOnly) {
  Packet first = idr(1);
  first.width_px = 641;
  const auto stream = parse(join({toBytes(first), toBytes(dependent(2)), toBytes(idr(3)),
                                  toBytes(dependent(4)), toBytes(dependent(5))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{3, 4, 5}));
  EXPECT_EQ(stream.statistics.other_size_frames, 1u);
  EXPECT_EQ(stream.statistics.waiting_frames, 1u);
}

TEST(Pave, APacketWithAnotherInItIsNotReadTwice) {
  Packet outer = idr(1);
  outer.payload = toBytes(dependent(2));
  outer.payload.push_back(0);
  const auto stream = parse(toBytes(outer));
  EXPECT_EQ(numbersOf(stream), Numbers{1});
  EXPECT_EQ(stream.frames[0].payload, outer.payload);
}

TEST(Pave, AnAbsurdNumberIsNoHole) {
  const auto stream = parse(join({toBytes(idr(1)), toBytes(dependent(2 + (1u << 30))),
                                  toBytes(dependent(3)), toBytes(idr(4)), toBytes(dependent(5))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 4, 5}));
  EXPECT_EQ(stream.statistics.broken_packets, 1u);
  EXPECT_EQ(stream.statistics.lost_frames, 1u);
  const auto in_idr = parse(join({toBytes(idr(1)), toBytes(idr(2 + (1u << 30))),
                                  toBytes(dependent(3)), toBytes(idr(4)), toBytes(dependent(5))}));
  EXPECT_EQ(numbersOf(in_idr).size(), 4u);
  EXPECT_EQ(in_idr.statistics.lost_frames, 0u);
}

TEST(Pave, ReorderedGroupsLeaveSoundOnes) {
  // The group of 3 and 4 comes after that of 5 and 6.
  const auto stream = parse(join({toBytes(idr(1)), toBytes(dependent(2)), toBytes(idr(5)),
                                  toBytes(dependent(6)), toBytes(dependent(4)), toBytes(idr(7))}));
  EXPECT_EQ(numbersOf(stream), (Numbers{1, 2, 5, 6, 7}));
  EXPECT_EQ(stream.statistics.misordered_frames, 1u);
}

TEST(Pave, RandomDamageNeverCrashesAndKeepsGroupsWhole) {
  std::vector<Bytes> packets;
  for (std::uint32_t i = 1; i <= 150; ++i)
    packets.push_back(toBytes(i % 15 == 1 ? idr(i) : dependent(i)));
  const Bytes whole = join(packets);
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    RandomSource random(seed);
    Bytes damaged = whole;
    const auto at = [&](int length) {
      return damaged.begin() + random.integer(0, static_cast<int>(damaged.size()) - length - 1);
    };
    for (int i = 0; i < 3; ++i) {
      *at(1) ^= static_cast<std::uint8_t>(1 << random.integer(0, 7));
      const int cut = random.integer(1, 200);
      const auto begin = at(cut);
      damaged.erase(begin, begin + cut);
      const Bytes garbage(static_cast<std::size_t>(random.integer(1, 200)),
                          static_cast<std::uint8_t>(random.integer(0, 255)));
      damaged.insert(at(1), garbage.begin(), garbage.end());
      const int swapped = random.integer(1, 300);
      std::rotate(damaged.begin(), damaged.begin() + swapped, damaged.end());
    }
    const auto stream = parse(damaged);
    // A frame is an IDR picture, or what the one before it is followed by.
    for (std::size_t i = 0; i < stream.frames.size(); ++i) {
      const PaveHeader& header = stream.frames[i].header;
      if (header.frame_type == PaveHeader::kIdr) continue;
      ASSERT_GT(i, 0u) << "seed " << seed;
      ASSERT_EQ(header.frame_number, stream.frames[i - 1].header.frame_number + 1)
          << "seed " << seed;
    }
    EXPECT_GT(stream.frames.size(), 30u) << "seed " << seed;
  }
}

TEST(Pave, EveryCutOfAStreamGivesItsWholePackets) {
  const Bytes bytes = join({toBytes(idr(1)), toBytes(dependent(2)), toBytes(dependent(3))});
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const auto stream = parsePave(bytes.data(), size);
    EXPECT_EQ(stream.frames.size(), size / 88) << size;
  }
}

TEST(PaveFile, FaultsAreNamedWithFileAndRemedy) {
  TemporaryFolder folder;
  const std::string path = folder.file("video.pave");
  const auto open = [&path] { openPave(path, {}); };
  const auto writeBytes = [&folder](const Bytes& bytes) {
    folder.write("video.pave", std::string(bytes.begin(), bytes.end()));
  };
  expectError(open, {"video.pave", "cannot be read"});
  folder.write("video.pave", "");
  expectError(open, {"video.pave", "no PaVE header", "5555"});
  writeBytes(toBytes(dependent(1)));
  expectError(open, {"video.pave", "1 packets", "IDR"});
  writeBytes(toBytes(idr(1)));  // a payload that is no H.264
  expectError(open, {"video.pave", "no picture can be decoded"});
}

/// A copy of the real stream that a test may damage.
Bytes realStream() {
  std::ifstream file(realData() + "/ardrone2_video/ardrone2_video_example.capture",
                     std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(RealPave, AllFramesDecodeAtTheirStamps) {
  if (realData().empty()) GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set";
  PaveOptions options;
  options.at_rest = true;
  const auto sequence =
      openPave(realData() + "/ardrone2_video/ardrone2_video_example.capture", options);
  EXPECT_TRUE(sequence->warnings().empty());
  ASSERT_EQ(sequence->size(), 517u);
  EXPECT_EQ(sequence->stamp_ns(0), 6215152'000'000);
  EXPECT_EQ(sequence->truth().size(), 517u);
  EXPECT_TRUE(sequence->T_base_cam().translation().isApprox(Eigen::Vector3d(0.21, 0, 0)));
  constexpr std::size_t kLate = 400;
  std::vector<cv::Mat> late;
  cv::Mat previous = sequence->image(0);
  EXPECT_EQ(previous.size(), cv::Size(640, 360));
  EXPECT_EQ(previous.type(), CV_8UC1);
  for (std::size_t i = 1; i < sequence->size(); ++i) {
    const double interval_s =
        static_cast<double>(sequence->stamp_ns(i) - sequence->stamp_ns(i - 1)) * 1e-9;
    ASSERT_NEAR(interval_s, 0.033, 0.033) << i;
    const cv::Mat image = sequence->image(i);
    // At rest neighbouring pictures look alike; a decoder out of step would smear them.
    ASSERT_LT(cv::norm(image, previous, cv::NORM_L1) / (640.0 * 360.0), 8.0) << i;
    previous = image;
    if (i >= kLate) late.push_back(image);
  }
  // Going back decodes again, in parts, and gives the same pictures.
  for (std::size_t i = sequence->size() - 1; i >= kLate; i -= 2)
    ASSERT_EQ(cv::norm(sequence->image(i), late.at(i - kLate), cv::NORM_INF), 0) << i;
  EXPECT_EQ(cv::norm(sequence->image(516), late.back(), cv::NORM_INF), 0);
}

TEST(RealPave, DamagedStreamKeepsPicturesAtTheirStamps) {
  if (realData().empty()) GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set";
  const Bytes whole = realStream();
  Bytes damaged = whole;
  const auto at = [&damaged](std::size_t i) {
    return damaged.begin() + static_cast<std::ptrdiff_t>(i);
  };
  damaged.resize(damaged.size() - 1000);
  damaged.erase(at(900'000), at(905'000));
  damaged.insert(at(300'000), 3000, 0x2a);
  TemporaryFolder folder;
  folder.write("damaged.pave", std::string(damaged.begin(), damaged.end()));
  PaveOptions options;
  options.camera_yaml = realData() + "/ardrone2_video/camera.yaml";
  const auto part = openPave(folder.file("damaged.pave"), options);
  const auto all = openPave(realData() + "/ardrone2_video/ardrone2_video_example.capture", options);
  EXPECT_GE(part->warnings().size(), 3u);
  EXPECT_LT(part->size(), all->size());
  EXPECT_GT(part->size(), 440u);  // each hole costs at most a group of 15 and what it swallowed
  EXPECT_TRUE(part->truth().empty());
  std::size_t j = 0;
  for (std::size_t i = 0; i < part->size(); ++i) {
    while (all->stamp_ns(j) < part->stamp_ns(i)) ++j;
    ASSERT_EQ(all->stamp_ns(j), part->stamp_ns(i));
    ASSERT_EQ(cv::norm(all->image(j), part->image(i), cv::NORM_INF), 0) << i;
  }
}

TEST(RealPave, CalibrationMustFitTheStream) {
  if (realData().empty()) GTEST_SKIP() << "ARDRONE_VSLAM_DATA is not set";
  TemporaryFolder folder;
  folder.write("camera.yaml", textCameraYaml("plumb_bob", "0, 0, 0, 0, 0"));
  PaveOptions options;
  options.camera_yaml = folder.file("camera.yaml");
  expectError(
      [&] { openPave(realData() + "/ardrone2_video/ardrone2_video_example.capture", options); },
      {"ardrone2_video_example.capture", "640x360", "32x24", "camera.yaml"});
}

}  // namespace
}  // namespace ardrone_vslam
