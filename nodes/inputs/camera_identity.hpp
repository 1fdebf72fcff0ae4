// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Features.h>

#include <cstdint>
#include <sstream>
#include <string>

namespace ardrone_vslam {

/// What the features tell of their camera.
struct CameraIdentity {
  std::string frame;  ///< optical frame; empty before the first features
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  float focal_length_px = 0;

  bool operator==(const CameraIdentity& other) const {
    return frame == other.frame && width_px == other.width_px && height_px == other.height_px &&
           focal_length_px == other.focal_length_px;
  }
  bool operator!=(const CameraIdentity& other) const { return !(*this == other); }

  /// For users: "cam (640x360, focal length 570.5 px)".
  std::string text() const {
    std::ostringstream text;
    text << frame << " (" << width_px << "x" << height_px << ", focal length " << focal_length_px
         << " px)";
    return text.str();
  }
};

inline CameraIdentity cameraOf(const Features& features) {
  return {features.header.frame_id, features.width, features.height, features.focal_length};
}

}  // namespace ardrone_vslam
