// SPDX-License-Identifier: BSD-3-Clause
#include "yaml/calibration.hpp"

#include <vector>

#include "ardrone_vslam/parameters.hpp"
#include "yaml/yaml_sections.hpp"

namespace ardrone_vslam {

CameraIntrinsics readCalibration(const std::string& path) {
  if (path.empty()) throw ConfigError({"onboard/camera names no calibration: give --camera FILE"});
  std::vector<std::string> faults;
  YamlSections sections = readYamlFile(path, faults);
  if (!faults.empty()) throw ConfigError(faults);
  const auto need = [&](bool is_good, const std::string& what) {
    if (!is_good)
      throw ConfigError({path + ": " + what + "; write it as ROS's camera_calibration does"});
  };
  const auto numbers = [&](const std::string& name) {
    std::vector<double> values;
    for (const std::string& item : listOf(sections[name]["data"])) {
      double value = 0;
      need(toNumber(item, value), name + "/data is missing or no list of numbers");
      values.push_back(value);
    }
    return values;
  };
  CameraIntrinsics camera;
  need(toNumber(sections[""]["image_width"], camera.width_px), "image_width is missing");
  need(toNumber(sections[""]["image_height"], camera.height_px), "image_height is missing");
  const std::string& model = sections[""]["distortion_model"];
  need(model == "plumb_bob", "distortion_model is '" + model + "' but must be plumb_bob");
  const std::vector<double> k = numbers("camera_matrix");
  need(k.size() == 9, "camera_matrix has not 9 numbers");
  std::vector<double> d = numbers("distortion_coefficients");
  need(d.empty() || d.size() == 4 || d.size() == 5, "distortion_coefficients has not 5 numbers");
  d.resize(5, 0.0);
  camera.fx_px = k[0];
  camera.cx_px = k[2];
  camera.fy_px = k[4];
  camera.cy_px = k[5];
  camera.k1 = d[0];
  camera.k2 = d[1];
  camera.p1 = d[2];
  camera.p2 = d[3];
  camera.k3 = d[4];
  const std::string fault = calibrationFault(camera);
  if (!fault.empty()) throw ConfigError({path + ": " + fault});
  return camera;
}

}  // namespace ardrone_vslam
