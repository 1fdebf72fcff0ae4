// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// The workstation's side of Telemetry: the newest image's features, and the map as far as it has
/// come.
class TelemetryReader {
 public:
  /// A landmark that does not come for so many rounds is no longer in the drone's map.
  static constexpr std::uint32_t kForgetRounds = 2;
  /// More than these are of no drone (400 MB of landmarks): all are forgotten then.
  static constexpr std::size_t kMostLandmarks = 1000000;

  /// One datagram, in order. @pre vslam_check calls it good (asserted)
  /// @return false when its contents cannot be; nothing of it is used then
  bool read(const std::uint8_t* datagram, std::size_t size);

  /// The drone's map began anew.
  void forgetLandmarks() { landmarks_.clear(); }

  /// Pixels, to a sixteenth, and ages, at most 255; the other arrays are empty.
  const ImageFeatures& features() const { return features_; }
  /// By ascending id: id, position and deviation; the rest is not sent.
  Landmarks landmarks() const;
  std::size_t size() const { return landmarks_.size(); }
  /// In the drone's map, when the datagram was sent.
  std::uint32_t landmarksOnDrone() const { return on_drone_; }

 private:
  struct Received {
    Landmark landmark;
    std::uint32_t round = 0;
  };
  void forgetOld(std::uint32_t round);

  ImageFeatures features_;
  std::map<std::uint32_t, Received> landmarks_;  // by id
  std::vector<Landmark> arrived_;                // of the datagram at work; kept for its memory
  std::uint32_t round_ = 0;
  std::uint32_t on_drone_ = 0;
};

}  // namespace ardrone_vslam
