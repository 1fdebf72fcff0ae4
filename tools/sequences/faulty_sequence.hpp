// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// View of a sequence whose set-up is wrong, to see what becomes of it.
/// @param fault  mirrored; late=SECONDS, of the images' stamps; focal=FACTOR, of the calibration's
///   focal length over the true one; roll=, pitch= or yaw=DEGREES, by which the mounting that is
///   told is turned about the camera's z (into the image), x (right) or y (down)
/// @throws std::invalid_argument that says what is wrong with `fault`
std::unique_ptr<Sequence> withFault(std::unique_ptr<Sequence> sequence, const std::string& fault);

}  // namespace ardrone_vslam
