// SPDX-License-Identifier: BSD-3-Clause
#include "folders/tum_folder.hpp"

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "folders/camera_yaml.hpp"
#include "folders/folder_files.hpp"
#include "folders/folder_sequence.hpp"
#include "folders/range_readings.hpp"

namespace ardrone_vslam {
namespace {

/// The poses of an optional file; none when it is not there. Another clock than the images' would
/// silently give every image the first or the last pose.
std::vector<StampedPose> readOptional(const std::string& path, bool is_ascending,
                                      const std::vector<std::int64_t>& stamps_ns) {
  if (!std::filesystem::exists(path)) return {};
  auto poses = is_ascending ? readTum(path).poses() : readTumPoses(path);
  if (poses.empty()) {
    throw std::runtime_error(path + ": holds no pose; fill it or remove it");
  }
  const std::int64_t first_ns = poses.front().stamp_ns;
  const std::int64_t last_ns = poses.back().stamp_ns;
  if (first_ns <= stamps_ns.back() && last_ns >= stamps_ns.front()) return poses;
  const auto seconds = [](std::int64_t stamp_ns) {
    return std::to_string(static_cast<double>(stamp_ns) * 1e-9);
  };
  throw std::runtime_error(path + ": its stamps, " + seconds(first_ns) + " to " + seconds(last_ns) +
                           " s, do not meet the images', " + seconds(stamps_ns.front()) + " to " +
                           seconds(stamps_ns.back()) + " s; give both in the same clock");
}

}  // namespace

bool isTumFolder(const std::string& path) {
  return std::filesystem::is_directory(path + "/image");
}

std::unique_ptr<Sequence> openTumFolder(const std::string& path) {
  FolderContents contents;
  contents.name = path;
  contents.image_paths = listImages(path + "/image");
  contents.calibration_path = path + "/camera.yaml";
  contents.camera = readCameraYaml(contents.calibration_path);
  contents.stamps_ns = readImageStamps(path + "/times.txt", contents.image_paths.size());
  contents.T_base_cam = forwardCamera();
  // A wrong calibration is told before the first minute of work, not in the midst of it.
  checkImageSize(readGreyImage(contents.image_paths.front()), contents.image_paths.front(),
                 contents.camera, contents.calibration_path);

  const Eigen::Isometry3d T_cam_base = contents.T_base_cam.inverse();
  for (const auto& pose : readOptional(path + "/poses_tum.txt", true, contents.stamps_ns)) {
    contents.truth.append({pose.stamp_ns, pose.T_frame_body * T_cam_base});
  }
  const std::string old_name = path + "/observer_tum.txt";
  if (std::filesystem::exists(old_name))
    throw std::runtime_error(old_name + ": is called odometry_tum.txt now; rename it");
  // A recorded odometry keeps its repeated and backward stamps: to stand them is the pipeline's
  // job.
  for (const auto& pose : readOptional(path + "/odometry_tum.txt", false, contents.stamps_ns)) {
    contents.odometry.push_back({pose.stamp_ns, pose.T_frame_body, Matrix6d::Zero()});
  }
  contents.ranges = readRanges(path + "/range.txt");
  return std::make_unique<FolderSequence>(std::move(contents));
}

}  // namespace ardrone_vslam
