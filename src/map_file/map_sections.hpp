// SPDX-License-Identifier: BSD-3-Clause
// What stands in a map file, section by section (docs/map_files.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "ardrone_vslam/saved_map.hpp"
#include "map_file/little_endian.hpp"

namespace ardrone_vslam {

constexpr char kMapMagic[] = "VSLAMMAP";
constexpr std::size_t kMapMagicSize = sizeof(kMapMagic) - 1;
constexpr std::uint32_t kMapSchema = 1;
constexpr std::size_t kMapHeaderSize = kMapMagicSize + 8;         // magic, schema, sections
constexpr std::size_t kSectionFrame = 16;                         // tag, size, check sum
constexpr std::uint64_t kMostMapBytes = std::uint64_t{1} << 31U;  // 2 GiB
constexpr char kDescriptorKind[] = "FREAK-512";
constexpr std::size_t kMostText = 255;  // bytes of a name
// Above `max_anchors` and the window's clones. The covariance of so many takes 0.3 GB of a file.
constexpr std::uint32_t kMostAnchors = 1100;

using SectionTag = std::array<char, 4>;
constexpr SectionTag kInfoTag{'I', 'N', 'F', 'O'};
constexpr SectionTag kCameraTag{'C', 'A', 'M', 'R'};
constexpr SectionTag kAnchorsTag{'A', 'N', 'C', 'H'};
constexpr SectionTag kLandmarksTag{'L', 'A', 'N', 'D'};
// Versions that do not know these skip them.
constexpr SectionTag kFlightTag{'k', 'e', 'y', 'f'};
constexpr SectionTag kMadeTag{'m', 'a', 'd', 'e'};
constexpr SectionTag kEndTag{'D', 'O', 'N', 'E'};

/// As text; what cannot be printed becomes "?".
std::string printable(const SectionTag& tag);

/// @throws MapFileError: the section's bytes are what somebody wrote, but what they say cannot be
[[noreturn]] void refuseSection(const SectionTag& tag, const std::string& what);

// What is wrong with a part of a map, so that a file with it is neither written nor read; empty if
// nothing is.
std::string infoFault(const SavedMap& map);
std::string madeFault(const std::string& made_by);
std::string anchorsFault(const SavedMap& map);

/// What cannot be; empty when it can.
std::string poseFault(const Eigen::Isometry3d& pose);
void writePose(const Eigen::Isometry3d& pose, ByteWriter& out);
Eigen::Isometry3d readPose(ByteReader& in);

std::size_t anchorsSize(std::size_t anchors);  ///< bytes of the section

void writeInfo(const SavedMap& map, ByteWriter& out);
/// What cannot be; empty when it can.
std::string camerasFault(const std::vector<MapCamera>& cameras);
void writeCameras(const std::vector<MapCamera>& cameras, ByteWriter& out);
/// Without their covariance.
void writeAnchors(const std::vector<MapAnchor>& anchors, ByteWriter& out);
/// The covariance from its first entry to the diagonal.
void writeCovarianceRow(const Eigen::MatrixXd& covariance, Eigen::Index row, ByteWriter& out);

// From the bytes of a section. Each throws MapFileError when they cannot be right.

/// Frame and stamp.
void readInfo(ByteReader in, SavedMap& map);
void readCameras(ByteReader in, SavedMap& map);
/// Program and version.
void readMade(ByteReader in, SavedMap& map);
/// With their covariance.
void readAnchors(ByteReader in, SavedMap& map);

}  // namespace ardrone_vslam
