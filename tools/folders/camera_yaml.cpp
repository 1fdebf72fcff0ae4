// SPDX-License-Identifier: BSD-3-Clause
#include "folders/camera_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "files/regular_file.hpp"

namespace ardrone_vslam {
namespace {

YAML::Node loadFile(const std::string& path) {
  const std::string text =
      readYamlText(path,
                   "the calibration is missing: calibrate the camera with ROS's "
                   "camera_calibration and put its yaml there");
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ": is not valid YAML: " + e.what());
  }
}

template <class T>
T get(const YAML::Node& root, const std::string& path, const std::string& key) {
  try {
    return root[key].as<T>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(path + ": " + key +
                             " is missing or not of its type; write the file as ROS's "
                             "camera_calibration does");
  }
}

std::vector<double> getData(const YAML::Node& root, const std::string& path,
                            const std::string& key) {
  const YAML::Node matrix = root[key];
  if (!matrix || !matrix.IsMap() || !matrix["data"]) {
    throw std::runtime_error(path + ": " + key +
                             " with its data is missing; write the file as ROS's "
                             "camera_calibration does");
  }
  try {
    return matrix["data"].as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(path + ": " + key + "/data is not a list of numbers");
  }
}

void readDistortion(const YAML::Node& root, const std::string& path, CameraIntrinsics& camera) {
  const auto model = get<std::string>(root, path, "distortion_model");
  if (model != "plumb_bob") {
    throw std::runtime_error(path + ": distortion_model '" + model +
                             "' is not supported; calibrate with plumb_bob (k1, k2, p1, p2, k3), "
                             "or rectify the images first");
  }
  auto d = getData(root, path, "distortion_coefficients");
  if (d.size() != 0 && d.size() != 4 && d.size() != 5) {
    throw std::runtime_error(path + ": plumb_bob has " + std::to_string(d.size()) +
                             " distortion coefficients, it must have 5 (k1, k2, p1, p2, k3)");
  }
  d.resize(5, 0.0);
  camera.k1 = d[0];
  camera.k2 = d[1];
  camera.p1 = d[2];
  camera.p2 = d[3];
  camera.k3 = d[4];
  if (!std::all_of(d.begin(), d.end(), [](double value) { return std::isfinite(value); })) {
    throw std::runtime_error(path + ": a distortion coefficient is not finite");
  }
}

}  // namespace

CameraIntrinsics readCameraYaml(const std::string& path) {
  const YAML::Node root = loadFile(path);
  if (!root.IsMap()) {
    throw std::runtime_error(path +
                             ": is empty or no map of keys; write it as ROS's "
                             "camera_calibration does");
  }
  CameraIntrinsics camera;
  camera.width_px = get<int>(root, path, "image_width");
  camera.height_px = get<int>(root, path, "image_height");
  const auto k = getData(root, path, "camera_matrix");
  if (k.size() != 9) {
    throw std::runtime_error(path + ": camera_matrix has " + std::to_string(k.size()) +
                             " numbers, it must have 9");
  }
  camera.fx_px = k[0];
  camera.cx_px = k[2];
  camera.fy_px = k[4];
  camera.cy_px = k[5];
  const bool is_possible = camera.width_px > 0 && camera.height_px > 0 && camera.fx_px > 0 &&
                           camera.fy_px > 0 && std::isfinite(camera.fx_px) &&
                           std::isfinite(camera.fy_px) && std::isfinite(camera.cx_px) &&
                           std::isfinite(camera.cy_px);
  if (!is_possible) {
    throw std::runtime_error(path +
                             ": image size and focal lengths must be positive and finite; "
                             "calibrate the camera");
  }
  readDistortion(root, path, camera);
  return camera;
}

}  // namespace ardrone_vslam
