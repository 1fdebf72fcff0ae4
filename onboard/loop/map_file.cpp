// SPDX-License-Identifier: BSD-3-Clause
#include "loop/map_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace ardrone_vslam {
namespace {

std::string faultOf(const std::string& path) {
  return path + ": the map cannot be written: " + std::strerror(errno);
}

}  // namespace

std::string writeLandmarks(const std::string& path, const std::vector<Landmark>& map) {
  const std::string part = path + ".part";
  std::FILE* file = std::fopen(part.c_str(), "w");
  bool is_good = file != nullptr;
  if (is_good) {
    std::fputs("id,x_m,y_m,z_m,sigma_m,depth_sigma_m,times_seen\n", file);
    for (const Landmark& l : map) {
      const Eigen::Vector3d& p = l.position_map;
      if (!p.allFinite() || !std::isfinite(l.sigma_m + l.depth_sigma_m)) continue;
      std::fprintf(file, "%u,%.9g,%.9g,%.9g,%.9g,%.9g,%d\n", l.id, p.x(), p.y(), p.z(), l.sigma_m,
                   l.depth_sigma_m, l.times_seen);
    }
    // The drone may be switched off next.
    is_good = std::ferror(file) == 0 && std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0;
    is_good = std::fclose(file) == 0 && is_good;
  }
  if (is_good) is_good = std::rename(part.c_str(), path.c_str()) == 0;
  return is_good ? "" : faultOf(path);
}

std::string mapFileFault(const std::string& path) {
  const std::string part = path + ".part";
  std::FILE* file = std::fopen(part.c_str(), "w");
  if (file == nullptr) return faultOf(path);
  std::fclose(file);
  std::remove(part.c_str());
  return "";
}

}  // namespace ardrone_vslam
