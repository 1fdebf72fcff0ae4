// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// `frame` under a tf_prefix, so that two drones share one tf tree: prefix/frame, unless it has the
/// prefix already (drivers give some frames with it and some without) or is absolute ("/map" stays
/// map).
std::string withTfPrefix(const std::string& prefix, const std::string& frame);

}  // namespace ardrone_vslam
