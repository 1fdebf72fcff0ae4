// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bags/bag_writer.hpp"
#include "driver/driver_faults.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {

struct DriverBagOptions {
  DriverFaults faults;
  std::string tf_prefix;         ///< empty: none, but `drone1` for the fault that needs one
  std::string camera = "front";  ///< a name of cameras(); what streams (first)
  OdometryProfile profile;       ///< how the drone's measurements drift
  BagWriteOptions::ImageFormat image_format = BagWriteOptions::ImageFormat::kRaw;
  BagCompression compression = BagCompression::kNone;
  std::string tool;  ///< name and version of the program, for the info topic
  std::function<void(std::size_t done)> progress;  ///< images; may be empty
};

/// Stamps of a driver's bag are times of reception by a computer whose clock is right; this is
/// where they begin.
constexpr std::int64_t kDriverBagBegin_ns = 1'400'000'000'000'000'000;

/// Writes the flight as ardrone_autonomy gives it to `rosbag record`: what DriverEmulation and
/// driver_video make, recorded at its reception. Besides the truth (PoseStamped in map, at the
/// packets' and not their receptions' times) and the note of how the bag was made, on the topics of
/// BagTopicNames. Images are the sequence's, of the camera that streams. Equal arguments give equal
/// bytes; nothing is left behind by a failure.
void writeDriverBag(const WorldSequence& world, const DriverBagOptions& options,
                    const std::string& path);

}  // namespace ardrone_vslam
