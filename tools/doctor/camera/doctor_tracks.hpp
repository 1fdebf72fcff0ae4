// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "doctor/recording/doctor_recording.hpp"

namespace ardrone_vslam {

/// What the tracker sees of a camera's images.
struct CameraTracks {
  std::string frame;
  CameraIntrinsics camera;
  std::vector<ImageFeatures> images;  ///< without descriptors, scores and ages
};

struct Tracks {
  std::vector<CameraTracks> cameras;  ///< in the order of their first image
  std::size_t looked_at = 0;          ///< images
  std::size_t undecodable = 0;
};

/// Of a long recording so many images are tracked, in stretches spread over it.
constexpr std::size_t kMostTrackedImages = 900;

/// Tracks the images that have a usable calibration.
/// @param progress  told how many images are done; may be empty
Tracks trackImages(const DoctorRecording& recording,
                   const std::function<void(std::size_t done)>& progress);

/// Images that trackImages looks at, ascending.
std::vector<std::size_t> imagesToTrack(std::size_t images, std::size_t most = kMostTrackedImages);

}  // namespace ardrone_vslam
