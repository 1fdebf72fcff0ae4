// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "configs/node_config.hpp"
#include "parameters/parameter_changes.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// What the mapper reads at its start.
struct MapperSettings {
  MapperNodeConfig node;
  SlamConfig slam;
  std::string tf_prefix;
};

/// What of it may change in flight.
struct MapperChanges {
  LandmarkMapConfig landmark_map;
  FrameBudgetConfig frame_budget;
  LoadedMapConfig loaded_map;
  OutputsConfig outputs;
  AutosaveConfig autosave;
};

template <class Visitor>
void visitParameters(MapperChanges& c, Visitor&& visit) {
  visitParameters(c.landmark_map, visit);
  visitParameters(c.frame_budget, visit);
  visitParameters(c.loaded_map, visit);
  visitParameters(c.outputs, visit);
  visitParameters(c.autosave, visit);
}

/// The mapper's parameters: as read at its start, and as changed since.
class MapperParameters {
 public:
  /// @param say  gets what is read, in one line. @throws ConfigError listing every fault
  MapperParameters(const ros::NodeHandle& private_nh, Warnings& warnings,
                   const std::function<void(const std::string&)>& say);
  /// From now on some may change.
  void offer(ParameterChanges<MapperChanges>::Use use);

  const MapperSettings& atStart() const { return at_start_; }
  /// "name=value" of each that is not as at the start.
  std::string changed() const { return changes_ ? changes_->changed() : ""; }

 private:
  ros::NodeHandle private_nh_;
  Warnings& warnings_;
  MapperSettings at_start_;
  std::unique_ptr<ParameterChanges<MapperChanges>> changes_;
};

}  // namespace ardrone_vslam
