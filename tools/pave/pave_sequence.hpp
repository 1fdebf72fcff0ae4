// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

struct PaveOptions {
  std::string camera_yaml;         ///< empty: camera.yaml beside the stream
  std::string bottom_camera_yaml;  ///< empty: none; its pictures have another size
  bool at_rest = false;  ///< the drone is known to have stood still: the truth is the identity
};

/// A recorded video stream of the AR.Drone 2.0. Images are cheapest in ascending order.
class PaveSequence : public Sequence {
 public:
  /// What was lost or left out, one sentence each; empty for a sound stream.
  virtual const std::vector<std::string>& warnings() const = 0;
};

/// The raw stream of the drone's TCP port (PaVE headers and H.264). Stamps are the drone's clock
/// (stampsOf). Pictures of the size of a calibration are that camera's, mounted as the driver's tf
/// says; others of the front camera's aspect ratio are the front camera's; the rest is left out.
/// The stream does not tell cameras of one size apart. There is no odometry in it.
/// @throws std::runtime_error naming the file, the fault and the remedy
std::unique_ptr<PaveSequence> openPave(const std::string& path, const PaveOptions& options);

}  // namespace ardrone_vslam
