// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "protocol/vslam_protocol.h"
#include "support/generated_image.hpp"
#include "support/read_file.hpp"

namespace ardrone_vslam::test {

using Record = std::array<std::uint8_t, VSLAM_OBSERVER_BYTES>;

/// A good state at rest.
inline VslamObserver odometryAt(std::int64_t stamp_ns, std::uint32_t sequence) {
  VslamObserver observer{};
  observer.sequence = sequence;
  observer.stamp_ns = stamp_ns;
  observer.quaternion[3] = 1;
  return observer;
}

inline Record recordOf(const VslamObserver& observer) {
  Record record;
  vslam_write_observer(&observer, record.data());
  return record;
}

/// An image of a stream, header included.
inline std::string pgm(std::int64_t stamp_ns, const TestImage& image) {
  return "P5\n# stamp_ns " + std::to_string(stamp_ns) + "\n" + std::to_string(image.width_px) +
         " " + std::to_string(image.height_px) + "\n255\n" +
         std::string(image.bytes.begin(), image.bytes.end());
}

inline void writeFile(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The answers in a file; none when one of them is damaged.
inline std::vector<VslamPose> posesIn(const std::string& path) {
  const std::string bytes = readFile(path);
  std::vector<VslamPose> poses;
  for (std::size_t at = 0; at + VSLAM_POSE_BYTES <= bytes.size(); at += VSLAM_POSE_BYTES) {
    VslamPose pose;
    const auto* record = reinterpret_cast<const std::uint8_t*>(bytes.data() + at);
    if (vslam_read_pose(record, VSLAM_POSE_BYTES, &pose) != VSLAM_GOOD) return {};
    poses.push_back(pose);
  }
  return poses;
}

/// Both ends of a pipe, closed at the end.
struct Pipe {
  Pipe() {
    if (::pipe(ends.data()) != 0) ends = {-1, -1};
  }
  Pipe& operator=(Pipe&& other) noexcept {
    std::swap(ends, other.ends);
    return *this;
  }
  ~Pipe() {
    close();
    if (ends[0] >= 0) ::close(ends[0]);
  }
  void write(const std::string& bytes) const {
    if (::write(ends[1], bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      ::abort();
  }
  /// The writer's.
  void close() {
    if (ends[1] >= 0) ::close(ends[1]);
    ends[1] = -1;
  }
  /// For whoever owns it.
  int reader() const { return ::dup(ends[0]); }

  std::array<int, 2> ends{};
};

}  // namespace ardrone_vslam::test
