// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "map_file/map_sections.hpp"

namespace ardrone_vslam {

/// What is wrong with a map's record, so that it is neither written nor read; empty if nothing is.
std::string flightFault(const FlightRecord& flight);

/// The numbers that landmarks have in a file, from 1 on.
class LandmarkNumbers {
 public:
  /// @param written  the landmarks, in the order of the file
  explicit LandmarkNumbers(const std::vector<std::uint32_t>& written);
  /// Landmarks that are not in the file have numbers behind those that are.
  std::uint32_t of(std::uint32_t landmark_id);

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> number_of_;
  std::uint32_t last_ = 0;
};

std::uint64_t flightSize(const FlightRecord& flight);  ///< bytes of the section

/// What comes before the keyframes, and behind them.
void writeFlightHead(const FlightRecord& flight, ByteWriter& out);
void writeKeyframe(const Keyframe& keyframe, LandmarkNumbers& numbers, ByteWriter& out);
void writeFlightTail(const FlightRecord& flight, ByteWriter& out);

/// Into map.flight. @throws MapFileError when the section's bytes cannot be right
void readFlight(ByteReader in, SavedMap& map);

}  // namespace ardrone_vslam
