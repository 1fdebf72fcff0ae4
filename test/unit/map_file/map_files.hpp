// SPDX-License-Identifier: BSD-3-Clause
// Maps to be saved, and map files taken apart and put together again.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "map_file/crc32.hpp"
#include "map_file/map_sections.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam::test {

inline MapCamera mapCamera() {
  return {640, 360, 561.5};
}

/// The same on every processor: each number is exact in the file.
inline SavedMap smallMap() {
  SavedMap map;
  map.frame_id = "house";
  map.stamp_ns = 1'000'000'000'000;
  map.cameras = {mapCamera()};
  map.anchors.resize(2);
  map.anchors[0].stamp_ns = 900'000'000'000;
  map.anchors[1].stamp_ns = 950'000'000'000;
  map.anchors[1].T_map_rig.translation() = Eigen::Vector3d(1, -2.5, 0.75);
  // By half a turn about (0.6, 0, 0.8).
  map.anchors[1].T_map_rig.linear() << -0.28, 0, 0.96, 0, -1, 0, 0.96, 0, 0.28;
  map.anchor_covariance = Eigen::MatrixXd::Identity(14, 14) / 64;
  for (int i = 0; i < 7; ++i)
    map.anchor_covariance(i, 7 + i) = map.anchor_covariance(7 + i, i) = 0.0078125;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Landmark landmark;
    landmark.id = 10 * (i + 1);
    for (std::size_t w = 0; w < 8; ++w) landmark.descriptor.words[w] = 0x0123456789ABCDEFU + w + i;
    landmark.position_map = Eigen::Vector3d(0.1, 0.2, 0.3) + i * Eigen::Vector3d::UnitX();
    Eigen::Matrix3d covariance_m2 = 0.015625 * Eigen::Matrix3d::Identity();
    covariance_m2(0, 2) = covariance_m2(2, 0) = -0.001953125;
    landmark.covariance_m2 = covariance_m2;
    landmark.view_direction_map[static_cast<int>(i)] = -1;
    landmark.seen_distance_m = 4.5;
    landmark.sigma_m = 0.125;
    landmark.depth_sigma_m = 0.25;
    landmark.parallax_rad = 0.0625;
    landmark.anchor_id = 1 + i % 2;
    landmark.times_seen = 20 + static_cast<int>(i);
    landmark.times_failed = static_cast<int>(i);
    landmark.first_seen_ns = map.stamp_ns - 60'000'000'000;
    landmark.last_seen_ns = map.stamp_ns - i * 1'000'000;
    map.landmarks.push_back(landmark);
  }
  return map;
}

/// A record that goes with smallMap().
inline FlightRecord smallFlight() {
  FlightRecord flight;
  flight.config.odometry.scale_sigma = 0.0625;
  flight.config.track_sigma_px = 0.5;
  Keyframe first;
  Keyframe second;
  first.stamp_ns = 900'000'000'000;
  second.stamp_ns = 950'000'000'000;
  first.focal_length_px = second.focal_length_px = 500;
  second.T_map_base = smallMap().anchors[1].T_map_rig;
  second.T_odom_base.translation() << 1, -2, 0.5;
  second.T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  second.way_variance_m2 = 0.25;
  second.way_m = 4;
  second.height_m = -0.5;
  second.floor = 1;
  KeyframeView view;
  view.track_id = 7;
  view.bearing_cam << 0, 0.6F, 0.8F;
  view.information_rad2 << 1024, -128, -128, 512;
  first.views = {view, view};
  first.views[1].track_id = 8;
  second.views = {view};
  second.landmarks = {{7, 20}, {8, 99}};  // number 2 in the file, and one that is not in it
  second.passed = {{925'000'000'000, second.T_odom_base}};
  flight.keyframes = {first, second};
  return flight;
}

/// How a landmark is after it was in a file: its own numbers in floats, ages in milliseconds.
inline Landmark randomLandmark(RandomSource& random, std::size_t anchors, std::int64_t stamp_ns) {
  Landmark landmark;
  for (std::uint64_t& word : landmark.descriptor.words)
    word = RandomSource::mix(static_cast<std::uint64_t>(1e18 * random.uniform()));
  landmark.position_map = 10 * random.normal3();
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i) = 0.1 * random.normal();
  landmark.covariance_m2 = root * root.transpose();
  for (double& value : landmark.covariance_m2.upper) {
    // Volatile: GCC 12 leaves the rounding to float and back out, at -O3, in a vector.
    const volatile float rounded = static_cast<float>(value);
    value = rounded;
  }
  landmark.view_direction_map = random.normal3().normalized().cast<float>();
  for (float* value : {&landmark.seen_distance_m, &landmark.sigma_m, &landmark.depth_sigma_m,
                       &landmark.parallax_rad})
    *value = static_cast<float>(random.uniform(0, 20));
  landmark.anchor_id = static_cast<std::uint32_t>(random.integer(1, static_cast<int>(anchors)));
  landmark.times_seen = random.integer(1, 1000);
  landmark.times_failed = random.integer(0, 9);
  landmark.first_seen_ns = stamp_ns - std::int64_t{1'000'000} * random.integer(0, 1'000'000'000);
  landmark.last_seen_ns = stamp_ns - std::int64_t{1'000'000} * random.integer(0, 1000);
  return landmark;
}

inline SavedMap randomMap(RandomSource& random, int most_anchors = 12, int most_landmarks = 50) {
  SavedMap map;
  map.frame_id = "map_" + std::to_string(random.integer(0, 1000));
  map.stamp_ns = static_cast<std::int64_t>(4e18 * random.uniform());
  map.cameras = {mapCamera()};
  map.cameras[0].focal_length_px = random.uniform(100, 900);
  const int anchors = random.integer(0, most_anchors);
  for (int i = 0; i < anchors; ++i) {
    MapAnchor anchor;
    anchor.stamp_ns = static_cast<std::int64_t>(4e18 * random.uniform());
    const Eigen::Vector3d axis = random.normal3().normalized();
    anchor.T_map_rig = Eigen::Translation3d(100 * random.normal3()) *
                       Eigen::AngleAxisd(random.chance(0.1) ? M_PI : random.uniform(0, M_PI), axis);
    map.anchors.push_back(anchor);
  }
  const int size = SavedMap::kAnchor * anchors;
  Eigen::MatrixXd root(size, random.chance(0.3) ? (size + 1) / 2 : size);  // of full rank or not
  for (Eigen::Index i = 0; i < root.size(); ++i) root(i) = random.normal();
  if (size > 0 && random.chance(0.3)) root.row(0).setZero();  // known exactly
  map.anchor_covariance = root * root.transpose();
  map.anchor_covariance.triangularView<Eigen::StrictlyUpper>() = map.anchor_covariance.transpose();
  const int landmarks = anchors > 0 ? random.integer(0, most_landmarks) : 0;
  for (int i = 0; i < landmarks; ++i)
    map.landmarks.push_back(randomLandmark(random, map.anchors.size(), map.stamp_ns));
  return map;
}

struct RawSection {
  std::string tag;
  std::string payload;
};

inline std::string bytesOf(const ByteWriter& writer) {
  return {writer.data(), writer.data() + writer.size()};
}

/// Number of `size` bytes at a place of a file or payload.
inline std::uint64_t numberAt(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes.at(at + i))} << (8 * i);
  return value;
}

/// All sections but the last.
inline std::vector<RawSection> sectionsOf(const std::string& file) {
  std::vector<RawSection> sections;
  std::size_t at = kMapHeaderSize;
  while (at < file.size()) {
    const auto size = static_cast<std::size_t>(numberAt(file, at + 4, 8));
    sections.push_back({file.substr(at, 4), file.substr(at + 12, size)});
    at += kSectionFrame + size;
  }
  sections.pop_back();
  return sections;
}

/// The sections with their check sums.
inline std::string joined(const std::vector<RawSection>& sections) {
  std::string file;
  for (const RawSection& section : sections) {
    ByteWriter bytes;
    bytes.raw(section.tag.data(), 4);
    bytes.u64(section.payload.size());
    bytes.raw(section.payload.data(), section.payload.size());
    Crc32 crc;
    crc.add(bytes.data(), bytes.size());
    bytes.u32(crc.value());
    file += bytesOf(bytes);
  }
  return file;
}

inline std::string headerOf(std::size_t sections, std::uint32_t schema = kMapSchema) {
  ByteWriter header;
  header.raw("VSLAMMAP", 8);
  header.u32(schema);
  header.u32(static_cast<std::uint32_t>(sections));
  return bytesOf(header);
}

/// A file of these sections and the last one.
inline std::string fileOf(const std::vector<RawSection>& sections) {
  const std::string body = joined(sections);
  ByteWriter size;
  size.u64(kMapHeaderSize + body.size() + kSectionFrame + 8);
  return headerOf(sections.size() + 1) + body + joined({{"DONE", bytesOf(size)}});
}

/// What reading the file is refused with; empty if it is a map.
inline std::string faultOf(const std::string& path) {
  try {
    readMap(path, WithFlight::kYes);
  } catch (const MapFileError& error) {
    return error.what();
  }
  return "";
}

/// Not over the old file: file systems wait for the disk when one is replaced so.
inline void writeFile(const std::string& path, const std::string& bytes) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace ardrone_vslam::test
