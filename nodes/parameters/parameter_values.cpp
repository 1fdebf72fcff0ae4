// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/parameter_values.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

template <class Entries, class T>
void appendTo(Entries& entries, const char* name, T value) {
  entries.emplace_back();
  entries.back().name = name;
  entries.back().value = value;
}

template <class Entries, class T>
void takeFrom(Entries& entries, const char* name, T& value) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [name](const auto& entry) { return entry.name == name; });
  if (found == entries.end()) return;
  value = static_cast<T>(found->value);
  entries.erase(found);
}

}  // namespace

ParameterValues noValues() {
  ParameterValues values;
  values.groups.resize(1);
  values.groups.front().name = "Default";
  values.groups.front().state = true;
  return values;
}

void append(const char* name, bool value, ParameterValues& values) {
  appendTo(values.bools, name, static_cast<std::uint8_t>(value));
}

void append(const char* name, int value, ParameterValues& values) {
  appendTo(values.ints, name, value);
}

void append(const char* name, double value, ParameterValues& values) {
  appendTo(values.doubles, name, value);
}

void take(const char* name, ParameterValues& values, bool& value) {
  takeFrom(values.bools, name, value);
}

void take(const char* name, ParameterValues& values, int& value) {
  takeFrom(values.ints, name, value);
}

void take(const char* name, ParameterValues& values, double& value) {
  takeFrom(values.doubles, name, value);
}

std::vector<std::string> faultsOfRest(const ParameterValues& values,
                                      const std::set<std::string>& known) {
  std::vector<std::string> faults;
  const auto refuse = [&](const auto& entries, const char* type) {
    for (const auto& entry : entries) {
      const bool is_known = known.count(entry.name) > 0;
      const std::string nearest = is_known ? "" : nearestName(entry.name, known);
      faults.push_back(entry.name +
                       (is_known ? std::string(" must not be ") + type
                                 : std::string(" may not be changed in flight, or is none")) +
                       (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
  };
  refuse(values.bools, "true or false");
  refuse(values.ints, "a whole number");
  refuse(values.doubles, "a number with a point");
  refuse(values.strs, "a text");
  return faults;
}

}  // namespace ardrone_vslam
