// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "configs/fake_driver_config.hpp"
#include "driver/driver_faults.hpp"
#include "driver/fake_drone.hpp"
#include "world/world.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {

/// @throws std::invalid_argument that names the parameter whose text is not known, and what is
void checkNames(const FakeDriverConfig& config);

/// What the texts mean. @throws std::invalid_argument, UsageError or std::runtime_error naming what
/// is not known and what is
bool hasAutopilot(const FakeDriverConfig& config);
DriverFaults faultsOf(const FakeDriverConfig& config);
World worldOf(const FakeDriverConfig& config);
FakeDroneOptions droneOf(const FakeDriverConfig& config);
std::string prefixOf(const FakeDriverConfig& config, const DriverFaults& faults);

}  // namespace ardrone_vslam
