// SPDX-License-Identifier: BSD-3-Clause
// Where things are. The paths are in one generated source alone (test/CMakeLists.txt), so that one
// compiler cache serves the other tests of every checkout.
#pragma once

#include <string>

namespace ardrone_vslam::test {

/// @param path  in the package's folder: "docs/doctor.md"
std::string packageFile(const std::string& path);
/// @param path  in test/data: "maps/version_1.vmap"
std::string dataFile(const std::string& path);
/// @param name  "replay"
/// @throws std::out_of_range  it is not built here
std::string program(const std::string& name);

}  // namespace ardrone_vslam::test
