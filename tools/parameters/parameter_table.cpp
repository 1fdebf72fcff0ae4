// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/parameter_table.hpp"

#include <iomanip>
#include <sstream>
#include <type_traits>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "config_files/config_file.hpp"
#include "configs/node_config.hpp"
#include "configs/onboard_config.hpp"
#include "driver/fake_driver_config.hpp"

namespace ardrone_vslam {
namespace {

constexpr const char* kHead =
    "# Parameters\n"
    "\n"
    "Made by `rosrun ardrone_vslam replay --list-parameters > docs/parameters.md`; edit the "
    "*Config structs, not this page.\n"
    "\n"
    "A configuration file (`config/*.yaml`) has two sections, `tracker:` and `mapper:`, and may "
    "have `odometry_fusion:` and `onboard:`, too. The launch "
    "files load each into the private namespace of its nodelet; the offline programs read the same "
    "file by `--config FILE` and single values by `--set name=value`. What is not given keeps its "
    "default. A value outside its range, of the wrong type or of an unknown name is refused with "
    "a message that lists all such faults.\n";

/// Writes one table row for each parameter.
struct RowWriter {
  std::ostringstream* out;

  template <class T>
  void operator()(const ParameterInfo& info, const T& value) const {
    *out << "| `" << info.name << "` | " << shown(value) << " | " << info.unit << " | "
         << rangeOf(info, value) << " | " << info.effect << " |\n";
  }

  template <class T>
  static std::string shown(const T& value) {
    std::ostringstream text;
    if constexpr (std::is_enum_v<T>) {
      text << nameOf(value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      text << '"' << value << '"';
    } else {
      text << std::boolalpha << value;
    }
    return text.str();
  }

  template <class T>
  static std::string rangeOf(const ParameterInfo& info, const T& /*value*/) {
    std::ostringstream text;
    if constexpr (std::is_enum_v<T>) {
      for (const char* name : EnumNames<T>::kNames) text << (text.tellp() > 0 ? ", " : "") << name;
    } else if constexpr (std::is_same_v<T, bool>) {
      text << "true, false";
    } else if constexpr (std::is_arithmetic_v<T>) {
      text << std::setprecision(10) << info.min << " to " << info.max;
    }
    return text.str();
  }
};

template <class Config>
void writeTable(const std::string& title, std::ostringstream& out) {
  out << "\n## " << title << "\n\n| name | default | unit | range | effect |\n"
      << "|---|---|---|---|---|\n";
  Config config;
  visitParameters(config, RowWriter{&out});
}

}  // namespace

std::string parameterTable() {
  std::ostringstream out;
  out << kHead;
  writeTable<TrackerConfig>("tracker: images to features", out);
  writeTable<SlamConfig>("mapper: features and odometry to poses and map", out);
  writeTable<TrackerNodeConfig>(
      "tracker, read by its nodelet; `rectified` and `rescale_calibration` by the offline tools "
      "(bags)",
      out);
  writeTable<MapperNodeConfig>("mapper, read by its nodelet only", out);
  writeTable<OdometryFusionNodeConfig>("odometry_fusion, read by its nodelet only", out);
  writeTable<DelayedFusionConfig>("odometry_fusion: odometry and corrections to odometry in map",
                                  out);
  writeTable<PathNodeConfig>("path nodelet", out);
  writeTable<FakeDriverConfig>("fake_driver", out);
  writeTable<OnboardConfig>("onboard, read by vslam_onboard only (docs/onboard.md)", out);
  writeTable<OnboardBridgeConfig>("onboard_bridge (docs/onboard.md)", out);
  return out.str();
}

}  // namespace ardrone_vslam
