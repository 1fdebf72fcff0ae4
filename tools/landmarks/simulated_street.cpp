// SPDX-License-Identifier: BSD-3-Clause
#include "landmarks/simulated_street.hpp"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "files/regular_file.hpp"
#include "folders/folder_files.hpp"
#include "folders/kitti_folder.hpp"
#include "simulation/random_source.hpp"
#include "trajectory/metrics.hpp"

namespace ardrone_vslam {
namespace {

/// Numbers of each line that has any; only the first line's are looked at.
struct FirstLook {
  std::size_t numbers = 0;
  std::size_t lines = 0;
};

FirstLook lookInto(const std::string& path) {
  std::ifstream file = openFile(path, kLargestTable_bytes, "give a file of KITTI or TUM poses");
  FirstLook look;
  std::string line;
  for (std::size_t line_number = 1; std::getline(file, line); ++line_number) {
    if (!line.empty() && line[0] == '#') continue;
    const std::size_t numbers = parseNumbers(line, path, line_number).size();
    if (numbers == 0) continue;
    if (look.lines++ == 0) look.numbers = numbers;
  }
  return look;
}

}  // namespace

void addStreet(PointWorld& world, const Trajectory& path, const StreetConfig& config,
               std::uint64_t seed) {
  assert(path.size() >= 2 && "a street needs a path");
  const std::vector<double> travelled_m = distancesAlong_m(path);
  const auto& poses = path.poses();
  RandomSource random(seed);
  for (int k = 0; k < config.landmarks; ++k) {
    const double along_m = random.uniform(0, travelled_m.back());
    const auto after = std::upper_bound(travelled_m.begin(), travelled_m.end() - 1, along_m);
    const Eigen::Isometry3d& near =
        poses[static_cast<std::size_t>(after - travelled_m.begin())].T_frame_body;
    const double side = random.chance(0.5) ? 1 : -1;
    const double away_m = random.uniform(config.nearest_m, config.farthest_m);
    const double up_m = random.uniform(config.lowest_m, config.highest_m);
    // Beyond the end of the path too, where the camera still looks.
    const double ahead_m = random.uniform(0, streetCamera().range_m / 2);
    world.addPoint(near * Eigen::Vector3d(ahead_m, side * away_m, up_m));
  }
}

PointCamera streetCamera() {
  PointCamera camera;
  camera.width_px = 1241;
  camera.height_px = 376;
  camera.focal_length_px = 718.856;
  camera.centre_px = {607.1928, 185.2157};
  camera.nearest_m = 1;
  camera.range_m = 40;
  return camera;
}

Trajectory readPath(const std::string& path) {
  const FirstLook look = lookInto(path);
  if (look.numbers == 8) return readTum(path);
  if (look.numbers != 12) {
    throw std::runtime_error(path + ": its first line has " + std::to_string(look.numbers) +
                             " numbers; 12 are a KITTI pose, 8 a TUM pose");
  }
  const std::filesystem::path times = std::filesystem::path(path).replace_filename("times.txt");
  if (std::filesystem::exists(times))
    return readKittiPoses(path, readImageStamps(times.string(), look.lines));
  constexpr std::int64_t kKittiInterval_ns = 100'000'000;
  std::vector<std::int64_t> stamps_ns(look.lines);
  for (std::size_t i = 0; i < stamps_ns.size(); ++i)
    stamps_ns[i] = static_cast<std::int64_t>(i) * kKittiInterval_ns;
  return readKittiPoses(path, stamps_ns);
}

}  // namespace ardrone_vslam
