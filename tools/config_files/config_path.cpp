// SPDX-License-Identifier: BSD-3-Clause
#include "config_files/config_path.hpp"

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace ardrone_vslam {

std::string findConfigFile(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;  // without /proc only the source folder is left
  const fs::path program_folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path share = fs::path("share") / "ardrone_vslam" / "config";
  const std::vector<fs::path> folders{
      program_folder / ".." / ".." / share,  // lib/ardrone_vslam/, as catkin installs
      program_folder / ".." / share,         // bin/, as plain CMake installs
      fs::path(ARDRONE_VSLAM_SOURCE_CONFIG)};
  std::string searched;
  for (const auto& folder : folders) {
    const fs::path candidate = (folder / name).lexically_normal();
    if (fs::is_regular_file(candidate, error)) return candidate.string();
    searched += (searched.empty() ? "" : ", ") + folder.lexically_normal().string();
  }
  throw std::runtime_error("the package's file config/" + name + " was not found in " + searched +
                           "; install the package again or name the file");
}

}  // namespace ardrone_vslam
