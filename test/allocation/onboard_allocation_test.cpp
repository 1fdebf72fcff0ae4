// SPDX-License-Identifier: BSD-3-Clause
// vslam_onboard's own code, beside the core: nothing is allocated once it runs.
#include <gtest/gtest.h>

#include "counted_allocations.hpp"
#include "input/frame_stream.hpp"
#include "input/observer_input.hpp"
#include "loop/answer_output.hpp"
#include "onboard/flight_records.hpp"
#include "protocol/telemetry.hpp"
#include "protocol/udp.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr int kPipedImages = 20;

/// @return allocations while `work` is done
template <class Work>
long during(const Work& work) {
  const long before = allocations;
  work();
  return allocations - before;
}

TEST(OnboardAllocation, NoneForImages) {
  Pipe pipe;
  FrameStream stream(FileDescriptor(pipe.reader()), -1, {32, 24, false}, true);
  const std::string bytes = pgm(1, generatedImage(32, 24));
  for (int i = 0; i < kPipedImages; ++i) pipe.write(bytes);
  Frame frame;
  EXPECT_EQ(during([&] {
              for (int i = 0; i < kPipedImages; ++i)
                ASSERT_EQ(stream.read(frame), FrameSource::Read::kFrame);
            }),
            0);
}

TEST(OnboardAllocation, NoneForRecordsGoodAndBad) {
  ObserverInput input;
  EXPECT_EQ(during([&] {
              for (std::uint32_t i = 1; i <= 100; ++i) {
                Record record = recordOf(odometryAt(i, i));
                ASSERT_TRUE(input.read(record.data(), record.size(), i));
                record[20] ^= 1;
                ASSERT_FALSE(input.read(record.data(), record.size(), i));
              }
            }),
            0);
}

TEST(OnboardAllocation, NoneForAnswersAndTelemetry) {
  const FileDescriptor controller = receiveAt({"127.0.0.1", 0});
  const FileDescriptor workstation = receiveAt({"127.0.0.1", 0});
  OnboardConfig config;
  config.pose_address = "127.0.0.1:" + std::to_string(portOf(controller.get()));
  config.telemetry_address = "127.0.0.1:" + std::to_string(portOf(workstation.get()));
  AnswerOutput output(config);
  const Landmarks landmarks(std::vector<Landmark>(500));
  const FrameResult result;
  const ImageFeatures features;
  EXPECT_EQ(during([&] {
              for (int i = 1; i <= kPipedImages; ++i) {
                output.sendPose(result, {});
                output.sendState(VSLAM_NO_OBSERVER, i, {});
                output.sendTelemetry(features, landmarks, std::int64_t{i} * 1'000'000'000);
              }
            }),
            0);
  std::array<std::uint8_t, Telemetry::kBytes> datagram;
  for (const FileDescriptor* socket : {&controller, &workstation}) {
    for (const std::uint32_t sequence : {1U, 2U}) {
      const long size = receive(*socket, datagram.data(), datagram.size());
      VslamPose pose{};
      ASSERT_EQ(vslam_read_pose(datagram.data(), static_cast<std::size_t>(size), &pose),
                VSLAM_GOOD);
      EXPECT_EQ(pose.sequence, sequence);
    }
  }
  EXPECT_GT(receive(workstation, datagram.data(), datagram.size()), 1000);
}

}  // namespace
}  // namespace ardrone_vslam::test
