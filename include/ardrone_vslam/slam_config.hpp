// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "ardrone_vslam/association.hpp"
#include "ardrone_vslam/constraint_filter.hpp"
#include "ardrone_vslam/drone_filter.hpp"
#include "ardrone_vslam/feature_map.hpp"
#include "ardrone_vslam/height_input.hpp"
#include "ardrone_vslam/landmark_map.hpp"
#include "ardrone_vslam/mapper.hpp"
#include "ardrone_vslam/observer_adapter.hpp"
#include "ardrone_vslam/observer_buffer.hpp"
#include "ardrone_vslam/parameters.hpp"
#include "ardrone_vslam/thesis_filter.hpp"

namespace ardrone_vslam {

/// Who makes the pose: docs/data_path.md.
enum class Estimator {
  kThesis,      ///< ThesisFilter
  kConstraint,  ///< ConstraintFilter
  kObserver     ///< nobody: the odometry is passed on
};
template <>
struct EnumNames<Estimator> {
  static constexpr std::array<const char*, 3> kNames{"thesis", "constraint", "observer"};
};

/// Everything of the mapper / localiser.
struct SlamConfig {
  Estimator estimator = Estimator::kConstraint;
  bool planar = false;
  double image_time_offset_s = 0;
  ObserverBufferConfig observer;
  ObserverAdapterConfig observer_adapter;
  DroneFilterConfig drone_filter;
  HeightInputConfig height_input;
  AssociationConfig association;
  ThesisFilterConfig thesis_filter;
  ConstraintFilterConfig constraint_filter;
  MapperConfig mapper;
  FeatureMapConfig feature_map;
  LandmarkMapConfig landmark_map;
};

template <class Visitor>
void visitParameters(SlamConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "estimator", "choice", 0, 0,
          "thesis: weighted mean and scalar fusion; constraint: tracks and landmarks of earlier "
          "visits correct pose and attitude; observer: passes the odometry on"},
      c.estimator);
  visit(
      ParameterInfo{
          "planar", "switch", 0, 0,
          "2-D mode: all z are zero, for a front camera when height and tilt are unknown"},
      c.planar);
  visit(ParameterInfo{"image_time_offset_s", "s", -5, 5,
                      "an image is exposed at its stamp plus this on the odometry's clock; "
                      "negative where the driver stamps images late (`status` and `replay` tell "
                      "what it seems to be)"},
        c.image_time_offset_s);
  visitParameters(c.observer, visit);
  visitParameters(c.observer_adapter, visit);
  visitParameters(c.drone_filter, visit);
  visitParameters(c.height_input, visit);
  visitParameters(c.association, visit);
  visitParameters(c.thesis_filter, visit);
  visitParameters(c.constraint_filter, visit);
  visitParameters(c.mapper, visit);
  visitParameters(c.feature_map, visit);
  visitParameters(c.landmark_map, visit);
}

}  // namespace ardrone_vslam
