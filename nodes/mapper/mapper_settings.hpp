// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "configs/node_config.hpp"

namespace ardrone_vslam {

/// What the mapper reads at its start.
struct MapperSettings {
  MapperNodeConfig node;
  SlamConfig slam;
  std::string tf_prefix;
};

}  // namespace ardrone_vslam
