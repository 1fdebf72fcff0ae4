// SPDX-License-Identifier: BSD-3-Clause
#include "folders/tum_folder_writer.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "folders/range_readings.hpp"
#include "trajectory/text_file.hpp"

namespace ardrone_vslam {
namespace {

namespace fs = std::filesystem;

/// As few digits as give the same number again.
std::string shortest(double value) {
  std::array<char, 40> text{};
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    if (std::strtod(text.data(), nullptr) == value) break;
  }
  return text.data();
}

std::string matrixYaml(const std::string& name, int rows, const std::vector<double>& data) {
  std::string text = name + ":\n  rows: " + std::to_string(rows) +
                     "\n  cols: " + std::to_string(data.size() / static_cast<std::size_t>(rows)) +
                     "\n  data: [";
  for (std::size_t i = 0; i < data.size(); ++i) text += (i > 0 ? ", " : "") + shortest(data[i]);
  return text + "]\n";
}

std::string cameraYaml(const CameraIntrinsics& c) {
  return "image_width: " + std::to_string(c.width_px) +
         "\nimage_height: " + std::to_string(c.height_px) + "\ncamera_name: camera\n" +
         matrixYaml("camera_matrix", 3, {c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1}) +
         "distortion_model: plumb_bob\n" +
         matrixYaml("distortion_coefficients", 1, {c.k1, c.k2, c.p1, c.p2, c.k3}) +
         matrixYaml("rectification_matrix", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         matrixYaml("projection_matrix", 3,
                    {c.fx_px, 0, c.cx_px, 0, 0, c.fy_px, c.cy_px, 0, 0, 0, 1, 0});
}

void writeImages(Sequence& sequence, const fs::path& folder, const TumFolderOptions& options) {
  fs::create_directories(folder / "image");
  std::string times;
  std::array<char, 40> text{};
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    std::snprintf(text.data(), text.size(), "%06zu.png", i);
    const fs::path path = folder / "image" / text.data();
    // Noise hardly compresses: more effort than 1 only takes time.
    if (!cv::imwrite(path.string(), sequence.image(i), {cv::IMWRITE_PNG_COMPRESSION, 1})) {
      throw std::runtime_error(path.string() + ": cannot be written; check the free space");
    }
    const std::int64_t stamp_ns = sequence.stamp_ns(i);
    std::snprintf(text.data(), text.size(), "%lld.%09lld\n",
                  static_cast<long long>(stamp_ns / 1000000000),
                  static_cast<long long>(stamp_ns % 1000000000));
    times += text.data();
    if (options.progress) options.progress(i + 1, sequence.size());
  }
  writeText((folder / "times.txt").string(), times);
}

void writePoses(const Sequence& sequence, const fs::path& folder, const TumFolderOptions& options) {
  const Eigen::Isometry3d T_base_cam = sequence.T_base_cam();
  if (!sequence.truth().empty()) {
    std::vector<StampedPose> T_world_cam;
    for (const auto& pose : sequence.truth().poses()) {
      T_world_cam.push_back({pose.stamp_ns, pose.T_frame_body * T_base_cam});
    }
    writeTumPoses((folder / "poses_tum.txt").string(), T_world_cam,
                  "T_world_cam, cam = optical frame");
  }
  if (!sequence.odometry().empty()) {
    const Eigen::Isometry3d T_base_folder = T_base_cam * forwardCamera().inverse();
    std::vector<StampedPose> T_odom_folder;
    for (const auto& state : sequence.odometry()) {
      T_odom_folder.push_back({state.stamp_ns, state.T_odom_base * T_base_folder});
    }
    writeTumPoses((folder / "odometry_tum.txt").string(), T_odom_folder,
                  "T_odom_base, base = the camera's position, x forward, y left, z up\n" +
                      options.odometry_comment);
  }
}

}  // namespace

void writeTumFolder(Sequence& sequence, const std::string& path, const TumFolderOptions& options) {
  const fs::path target =
      fs::path(path).has_filename() ? fs::path(path) : fs::path(path).parent_path();
  if (fs::exists(target)) {
    throw std::runtime_error(path + ": exists already; remove it or give another name");
  }
  const fs::path unfinished = target.string() + ".part";
  try {
    fs::remove_all(unfinished);
    writeImages(sequence, unfinished, options);
    writeText((unfinished / "camera.yaml").string(), cameraYaml(sequence.camera()));
    writePoses(sequence, unfinished, options);
    const std::vector<RangeReading> ranges = sequence.ranges();
    if (!ranges.empty()) writeRanges((unfinished / "range.txt").string(), ranges);
    fs::rename(unfinished, target);
  } catch (const fs::filesystem_error& e) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw std::runtime_error(path + ": cannot be written (" + e.code().message() +
                             "); check the path, its permissions and the free space");
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw;
  }
}

}  // namespace ardrone_vslam
