// SPDX-License-Identifier: BSD-3-Clause
// The AR.Drone's video stream with pictures that can be decoded.
#pragma once

#include <string>
#include <vector>

#include "support/h264_pictures.hpp"
#include "support/pave_packets.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {

/// Groups of 5 frames, each of another grey.
class PaveCapture {
 public:
  /// @param number  of the first frame @param timestamp_ms  likewise; 33 more for each
  void add(int groups, unsigned width_px, unsigned height_px, std::uint32_t number,
           std::int64_t timestamp_ms, int step_ms = 33) {
    H264Pictures pictures(width_px, height_px);
    for (int i = 0; i < 5 * groups; ++i) {
      const bool is_idr = i % 5 == 0;
      if (is_idr) luma_ = static_cast<std::uint8_t>(luma_ + 10);
      Packet packet = is_idr ? idr(number) : dependent(number);
      packet.width_px = static_cast<std::uint16_t>(width_px);
      packet.height_px = static_cast<std::uint16_t>(height_px);
      packet.timestamp_ms = timestamp_ms;
      packet.payload = is_idr ? pictures.idr(luma_) : pictures.repeated();
      const Bytes bytes = toBytes(packet);
      text_.append(bytes.begin(), bytes.end());
      lumas_.push_back(luma_);
      ++number;
      timestamp_ms += step_ms;
    }
  }
  const std::string& text() const { return text_; }
  /// Of each frame added.
  const std::vector<std::uint8_t>& lumas() const { return lumas_; }

 private:
  std::string text_;
  std::uint8_t luma_ = 40;
  std::vector<std::uint8_t> lumas_;
};

/// Of the test's camera, as if its pictures had that size.
inline std::string paveCameraYaml(int width_px, int height_px) {
  std::string yaml = textCameraYaml("plumb_bob", "0, 0, 0, 0, 0");
  const auto replace = [&yaml](const std::string& from, const std::string& to) {
    ASSERT_NE(yaml.find(from), std::string::npos) << yaml;
    yaml.replace(yaml.find(from), from.size(), to);
  };
  replace("image_width: 32", "image_width: " + std::to_string(width_px));
  replace("image_height: 24", "image_height: " + std::to_string(height_px));
  return yaml;
}

}  // namespace ardrone_vslam
