// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Status.h>

#include <cstddef>
#include <cstdint>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/slam.hpp"
#include "protocol/vslam_protocol.h"

/// vslam_onboard's answers and telemetry as the core has them on a workstation.
namespace ardrone_vslam {

/// An answer with a pose, as its Slam had it; what is not sent keeps its default. The covariance
/// has its diagonal only.
/// @param stamp_ns  the image's, by this computer's clock
FrameResult toFrameResult(const VslamPose& pose, std::int64_t stamp_ns);

/// State, name, reason and counts of any answer; leaves its own counts alone.
void toStatus(const VslamPose& pose, Status& status);

/// What a calibration adds to pixels: size, focal length and bearings. Features that are not in its
/// image or beyond its lens are left out. @return how many
std::size_t addBearings(const CameraModel& camera, ImageFeatures& features);

}  // namespace ardrone_vslam
