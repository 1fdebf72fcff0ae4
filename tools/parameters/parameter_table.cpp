// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/parameter_table.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <type_traits>
#include <vector>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "config_files/config_file.hpp"
#include "configs/fake_driver_config.hpp"
#include "configs/node_config.hpp"
#include "configs/onboard_config.hpp"

namespace ardrone_vslam {
namespace {

constexpr const char* kHead =
    "# Parameters\n"
    "\n"
    "Made by `rosrun ardrone_vslam replay --list-parameters > docs/parameters.md`; edit the "
    "*Config structs, not this page.\n"
    "\n"
    "A configuration file (`config/*.yaml`) has two sections, `tracker:` and `mapper:`, and may "
    "have `odometry_fusion:` and `onboard:`, too. The launch files load each into the private "
    "namespace of its nodelet. The offline programs read the same file by `--config FILE` and "
    "single values by `--set name=value`. What is not given keeps its default. A value outside its "
    "range, of the wrong type or of an unknown name is refused with a message that lists all such "
    "faults.\n";

/// Of the page: one name, in all the sections that have it with the same text.
struct Row {
  PagePlace place;
  std::string name;
  std::vector<std::string> sections;
  std::vector<std::string> defaults;  ///< of each section
  std::string unit;
  std::string range;
  std::string effect;
};

template <class T>
std::string shown(const T& value) {
  if constexpr (std::is_same_v<T, std::string>) return '"' + value + '"';
  return textOf(value);
}

template <class T>
std::string rangeOf(const ParameterInfo& info) {
  std::ostringstream text;
  if constexpr (std::is_enum_v<T>) {
    for (const char* name : EnumNames<T>::kNames) text << (text.tellp() > 0 ? ", " : "") << name;
  } else if constexpr (std::is_same_v<T, bool>) {
    text << "true, false";
  } else if constexpr (!std::is_same_v<T, std::string>) {
    if constexpr (std::is_same_v<T, NumberOrAuto>) text << kAuto << ", ";
    text << std::setprecision(10) << info.min << " to " << info.max;
  }
  return text.str();
}

/// Adds one section's parameters to the rows.
struct RowCollector {
  std::string section;
  std::vector<Row>* rows;

  template <class T>
  void operator()(const ParameterInfo& info, const T& value) const {
    auto row = std::find_if(rows->begin(), rows->end(), [&info](const Row& other) {
      return other.name == info.name && other.effect == info.effect;
    });
    if (row == rows->end()) {
      rows->push_back({info.place, info.name, {}, {}, info.unit, rangeOf<T>(info), info.effect});
      row = rows->end() - 1;
    }
    row->sections.push_back(section);
    row->defaults.push_back(shown(value));
  }
};

template <class Config>
void collect(const std::string& section, std::vector<Row>& rows) {
  Config config;
  visitParameters(config, RowCollector{section, &rows});
}

std::vector<Row> allRows() {
  std::vector<Row> rows;
  collect<TrackerConfig>("tracker", rows);
  collect<TrackerNodeConfig>("tracker", rows);
  collect<SlamConfig>("mapper", rows);
  collect<MapperNodeConfig>("mapper", rows);
  collect<DelayedFusionConfig>("odometry_fusion", rows);
  collect<OdometryFusionNodeConfig>("odometry_fusion", rows);
  collect<FakeDriverConfig>("fake_driver", rows);
  collect<OnboardConfig>("onboard", rows);
  collect<OnboardBridgeConfig>("onboard_bridge", rows);
  collect<CameraNodeConfig>("camera", rows);
  return rows;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// One default where all sections agree, else that of each.
std::string defaultsOf(const Row& row) {
  const auto differs = [&row](const std::string& value) { return value != row.defaults.front(); };
  if (std::none_of(row.defaults.begin(), row.defaults.end(), differs)) return row.defaults.front();
  std::vector<std::string> each;
  for (std::size_t i = 0; i < row.sections.size(); ++i)
    each.push_back(row.defaults[i] + " (" + row.sections[i] + ")");
  return joined(each);
}

template <class Chosen>
void writeTable(const std::string& title, std::vector<Row> rows, std::ostringstream& out,
                const Chosen& is_chosen) {
  out << "\n## " << title << "\n\n| name | in | default | unit | range | effect |\n"
      << "|---|---|---|---|---|---|\n";
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.place.rank < b.place.rank; });
  for (const Row& row : rows) {
    if (!is_chosen(row)) continue;
    out << "| `" << row.name << "` | " << joined(row.sections) << " | " << defaultsOf(row) << " | "
        << row.unit << " | " << row.range << " | " << row.effect << " |\n";
  }
}

const char* kindOf(OldName::Kind kind) {
  switch (kind) {
    case OldName::Kind::kParameter:
      return "parameter of ";
    case OldName::Kind::kChoice:
      return "value of ";
    case OldName::Kind::kSection:
      return "section";
    case OldName::Kind::kOption:
      return "option of ";
    case OldName::Kind::kLaunchArgument:
      return "argument of ";
    case OldName::Kind::kNode:
      return "node or nodelet";
  }
  return "";
}

void writeOldNames(std::ostringstream& out) {
  out << "\n## Old names\n\nRefused, or warned of where unknown names are, with the new one. "
         "Nodes and nodelets are not: ROS says that they are not found. All "
         "other parameters of earlier versions are refused with the reason why they are none any "
         "more.\n\n"
         "- old name, what it was, name now\n";
  for (const OldName& old : oldNames()) {
    if (*old.now == '\0') continue;
    out << "- `" << old.name << "`, " << kindOf(old.kind) << old.owner << ": `" << old.now << '`'
        << (*old.why == '\0' ? "" : ", ") << old.why << '\n';
  }
}

}  // namespace

std::string parameterTable() {
  const std::vector<Row> rows = allRows();
  std::ostringstream out;
  out << kHead;
  const auto isOfProgram = [](const Row& row) {
    const std::string& first = row.sections.front();
    return first == "fake_driver" || first == "onboard" || first == "onboard_bridge" ||
           first == "camera";
  };
  const auto part = [&isOfProgram](PagePart wanted) {
    return [&isOfProgram, wanted](const Row& row) {
      return row.place.part == wanted && !isOfProgram(row);
    };
  };
  const auto program = [&isOfProgram](const std::string& section) {
    return [&isOfProgram, section](const Row& row) {
      const auto& all = row.sections;
      return isOfProgram(row) && std::find(all.begin(), all.end(), section) != all.end();
    };
  };
  writeTable("What to turn first", rows, out, part(PagePart::kUser));
  writeTable("Advanced", rows, out, part(PagePart::kAdvanced));
  writeTable("Thesis: estimator thesis", rows, out, part(PagePart::kThesis));
  writeTable("fake_driver", rows, out, program("fake_driver"));
  writeTable("onboard: vslam_onboard (docs/onboard.md)", rows, out, program("onboard"));
  writeTable("onboard_bridge (docs/onboard.md)", rows, out, program("onboard_bridge"));
  writeTable("camera: camera_node (docs/any_robot.md)", rows, out, program("camera"));
  writeOldNames(out);
  return out.str();
}

}  // namespace ardrone_vslam
