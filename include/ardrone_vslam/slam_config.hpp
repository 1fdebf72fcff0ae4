// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/landmark_map.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

enum class Estimator { kThesis, kObserver };
template <>
struct EnumNames<Estimator> {
  static constexpr std::array<const char*, 2> kNames{"thesis", "observer"};
};

struct SlamConfig {
  Estimator estimator = Estimator::kThesis;
  LandmarkMapConfig landmark_map;
};

template <class Visitor>
void visitParameters(SlamConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"estimator", "choice", 0, 0,
                      "thesis: weighted mean and scalar fusion; observer: passes the odometry on"},
        c.estimator);
  visitParameters(c.landmark_map, visit);
}

}  // namespace ardrone_vslam
