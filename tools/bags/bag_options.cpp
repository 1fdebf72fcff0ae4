// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_options.hpp"

#include <CLI/CLI.hpp>

#include "folders/camera_yaml.hpp"
#include "program/tool_main.hpp"

namespace ardrone_vslam {

void BagOptions::addTo(CLI::App& app) {
  const auto add = [this, &app](const std::string& name, std::string& value,
                                const std::string& what) {
    options_.push_back(app.add_option(name, value, what));
  };
  add("--image-topic", bag_.image_topic, "of a bag; default: the only one there is");
  add("--camera-info-topic", bag_.camera_info_topic, "of a bag; default: beside the images");
  add("--odometry-topic", bag_.odometry_topic, "of a bag; default: the only one there is");
  add("--navdata-topic", bag_.navdata_topic,
      "of a bag, with odometry_mode navdata or use_navdata_height; default: the only one there is");
  add("--imu-topic", bag_.imu_topic,
      "of a bag, with odometry_mode navdata or imu; default: the only one there is, if any");
  add("--command-topic", bag_.command_topic,
      "cmd_vel in a bag, with odometry_mode navdata; default: the only Twist there is, if any");
  add("--truth-topic", bag_.truth_topic, "of a bag; default: the one called truth");
  add("--range-topic", bag_.range_topic,
      "of a bag, with use_range; default: the only one there is");
  add("--camera-frame", bag_.camera_frame, "of a bag; default: the images' frame_id");
  add("--base-frame", bag_.base_frame,
      "of a bag; default: mapper/base_frame of the configuration, else the odometry's "
      "child_frame_id");
  add("--camera", camera_yaml_, "calibration to use instead of a bag's camera_info");
}

void BagOptions::refuseForFolder(const std::string& folder) const {
  std::string given;
  for (const CLI::Option* option : options_) {
    if (option->count() > 0) given += (given.empty() ? "" : ", ") + option->get_name();
  }
  if (given.empty()) return;
  throw UsageError(folder + ": is a folder, and " + given +
                   " is for bags only; leave it out (a folder's files say it)");
}

BagReadOptions BagOptions::read(const PipelineConfig& config) const {
  BagReadOptions options = bag_;
  options.rectified = config.rectified;
  options.rescale_calibration = config.rescale_calibration;
  options.use_range = config.mapper.height_input.use_range;
  options.use_navdata_height = config.mapper.height_input.use_navdata_height;
  options.odometry_mode = config.mapper.odometry_adapter.mode;
  if (options.base_frame.empty()) options.base_frame = config.base_frame;
  if (!camera_yaml_.empty()) options.camera = readCameraYaml(camera_yaml_);
  return options;
}

}  // namespace ardrone_vslam
