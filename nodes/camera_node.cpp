// SPDX-License-Identifier: BSD-3-Clause
#include "standalone.hpp"

int main(int argc, char** argv) {
  return ardrone_vslam::runStandalone(argc, argv, "camera", "ardrone_vslam/CameraNodelet");
}
