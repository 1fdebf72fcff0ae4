// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/algorithm/string/predicate.hpp>
#include <string>

namespace ardrone_vslam {

/// The name up to its last slash; empty where there is none.
inline std::string parentName(const std::string& topic) {
  const auto slash = topic.rfind('/');
  return slash == std::string::npos ? std::string() : topic.substr(0, slash);
}

/// Whether a topic of images may be the camera's. Of one image recorded in both ways the raw one
/// is.
/// @param topics  all of them, by name
template <class Topics>
bool mayBeCameraImage(const std::string& topic, bool is_compressed, const Topics& topics) {
  const bool is_second = is_compressed && topics.count(parentName(topic)) != 0;
  return !is_second && !boost::algorithm::ends_with(topic, "/compressedDepth") &&
         !boost::algorithm::ends_with(topic, "/debug_image");
}

/// Whether the mapper and its neighbours publish it: that is no odometry to start from.
inline bool isFusedOdometry(const std::string& topic) {
  return boost::algorithm::ends_with(topic, "odometry_fused") ||
         boost::algorithm::ends_with(topic, "odometry_live") ||
         boost::algorithm::ends_with(topic, "observer_odometry");
}

}  // namespace ardrone_vslam
