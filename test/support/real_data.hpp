// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string>

namespace ardrone_vslam::test {

/// The folder of real data; empty when ARDRONE_VSLAM_DATA is unset.
inline std::string realData() {
  const char* folder = std::getenv("ARDRONE_VSLAM_DATA");
  return folder == nullptr ? std::string() : folder;
}

}  // namespace ardrone_vslam::test
