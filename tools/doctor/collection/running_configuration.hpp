// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/doctor_configuration.hpp"

namespace ardrone_vslam {

/// The parameters of the mapper that runs and of the tracker beside it. None, or more than one
/// mapper: not known.
DoctorConfiguration runningConfiguration();

}  // namespace ardrone_vslam
