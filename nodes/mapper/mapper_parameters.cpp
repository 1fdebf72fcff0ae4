// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/mapper_parameters.hpp"

#include <utility>

#include "ardrone_vslam/slam.hpp"
#include "with_ros/params.hpp"

namespace ardrone_vslam {

MapperParameters::MapperParameters(const ros::NodeHandle& private_nh, Warnings& warnings,
                                   const std::function<void(const std::string&)>& say)
    : private_nh_(private_nh), warnings_(warnings) {
  ParamReader reader(private_nh);
  reader.read(at_start_.node);
  reader.read(at_start_.slam);
  at_start_.tf_prefix = tfPrefixOf(private_nh);
  for (const auto& sentence : reader.unknownKeys()) warnings.say(sentence);
  reader.finish();
  // Some faults lie between parameters: tell them now, not in mid-air.
  const Slam trial(at_start_.slam, Eigen::Isometry3d::Identity());
  say("ardrone_vslam " ARDRONE_VSLAM_VERSION " mapper: " + reader.summary() +
      (at_start_.tf_prefix.empty() ? "" : " tf_prefix=" + at_start_.tf_prefix));
}

void MapperParameters::offer(ParameterChanges<MapperChanges>::Use use) {
  const SlamConfig& slam = at_start_.slam;
  const MapperNodeConfig& node = at_start_.node;
  const MapperChanges now{slam.landmark_map, slam.frame_budget, slam.msckf, node.outputs,
                          node.autosave};
  changes_ = std::make_unique<ParameterChanges<MapperChanges>>(private_nh_, now, warnings_,
                                                               std::move(use));
}

}  // namespace ardrone_vslam
