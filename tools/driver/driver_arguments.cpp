// SPDX-License-Identifier: BSD-3-Clause
#include "driver/driver_arguments.hpp"

#include <CLI/CLI.hpp>

#include "program/tool_main.hpp"

namespace ardrone_vslam {

void addDriverOptions(CLI::App& app, DriverArguments& arguments) {
  arguments.driver = app.add_option("--driver", arguments.name,
                                    "write the bag as this driver publishes the flight: ardrone "
                                    "(ardrone_autonomy's topics, types, frames, rates and stamps)")
                         ->check(CLI::IsMember({"ardrone"}));
  std::string faults = "of the driver, may be given often: ";
  for (const DriverFaultInfo& info : driverFaults()) {
    faults += info.name + " (" + info.summary + "); ";
  }
  faults += "released: " + nameList(driverFaultsNamed({"released"})) + "; all";
  app.add_option("--fault", arguments.fault_names, faults)
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_option("--tf-prefix", arguments.tf_prefix,
                 "of the driver's frames; default: none, with unprefixed_frame drone1");
}

void resolveDriver(DriverArguments& arguments, const WorldOptions& world) {
  if (!arguments.isChosen()) {
    if (arguments.fault_names.empty() && arguments.tf_prefix.empty()) return;
    throw UsageError("--fault and --tf-prefix are the driver's; add --driver ardrone");
  }
  if (world.range_noise_m) {
    throw UsageError(
        "--range-noise: the driver publishes no ranges; its height is in the navdata's altd");
  }
  if (arguments.tf_prefix.find('/') != std::string::npos) {
    throw UsageError("--tf-prefix: '" + arguments.tf_prefix + "' must be a name without '/'");
  }
  arguments.faults = asUsage([&arguments] { return driverFaultsNamed(arguments.fault_names); });
}

}  // namespace ardrone_vslam
