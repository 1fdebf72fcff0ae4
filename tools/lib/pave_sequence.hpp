// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sequence.hpp"

namespace ardrone_vslam {

struct PaveOptions {
  std::string camera_yaml;  ///< empty: camera.yaml beside the stream
  bool at_rest = false;     ///< the drone is known to have stood still: the truth is the identity
};

/// A recorded video stream of the AR.Drone 2.0. Images are cheapest in ascending order.
class PaveSequence : public Sequence {
 public:
  /// What was lost or left out, one sentence each; empty for a sound stream.
  virtual const std::vector<std::string>& warnings() const = 0;
};

/// The raw stream of the drone's TCP port (PaVE headers and H.264). Stamps are the drone's clock;
/// T_base_cam is the front camera's, 0.21 m ahead of base. There is no observer in the stream.
/// @throws std::runtime_error naming the file, the fault and the remedy
std::unique_ptr<PaveSequence> openPave(const std::string& path, const PaveOptions& options);

}  // namespace ardrone_vslam
