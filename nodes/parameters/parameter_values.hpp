// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "ardrone_vslam/parameters.hpp"

/// *Config structs of switches, whole numbers and numbers in the messages of dynamic_reconfigure.
namespace ardrone_vslam {

/// Values by their names, of each type apart.
using ParameterValues = dynamic_reconfigure::Config;

/// Without values: of the one group that all parameters are in.
ParameterValues noValues();
void append(const char* name, bool value, ParameterValues& values);
void append(const char* name, int value, ParameterValues& values);
void append(const char* name, double value, ParameterValues& values);
/// Moves the value of this name out of `values`, where it is there with this type.
void take(const char* name, ParameterValues& values, bool& value);
void take(const char* name, ParameterValues& values, int& value);
void take(const char* name, ParameterValues& values, double& value);
/// One sentence for each value that nothing took. @param known  all names
std::vector<std::string> faultsOfRest(const ParameterValues& values,
                                      const std::set<std::string>& known);

template <class Config>
ParameterValues valuesOf(Config config) {
  ParameterValues values = noValues();
  visitParameters(config,
                  [&](const ParameterInfo& info, auto& v) { append(info.name, v, values); });
  return values;
}

/// Puts the values that are given into the struct.
/// @return one sentence for each that is none of its parameters, of another type or out of range
template <class Config>
std::vector<std::string> takeOver(ParameterValues values, Config& config) {
  std::set<std::string> known;
  visitParameters(config, [&](const ParameterInfo& info, auto& v) {
    known.insert(info.name);
    take(info.name, values, v);
  });
  std::vector<std::string> faults = faultsOfRest(values, known);
  const std::vector<std::string> out_of_range = rangeFaults(config);
  faults.insert(faults.end(), out_of_range.begin(), out_of_range.end());
  return faults;
}

/// Names, types, effects, ranges and defaults, as rqt_reconfigure shows them.
template <class Config>
dynamic_reconfigure::ConfigDescription descriptionOf() {
  Config config;
  dynamic_reconfigure::ConfigDescription description;
  description.dflt = valuesOf(config);
  description.min = description.max = noValues();
  description.groups.resize(1);
  description.groups.front().name = description.dflt.groups.front().name;
  visitParameters(config, [&](const ParameterInfo& info, auto& v) {
    using T = std::decay_t<decltype(v)>;
    constexpr bool kIsSwitch = std::is_same_v<T, bool>;
    dynamic_reconfigure::ParamDescription one;
    one.name = info.name;
    one.type = kIsSwitch ? "bool" : std::is_same_v<T, int> ? "int" : "double";
    one.description =
        std::string(info.effect) + (kIsSwitch ? "" : std::string(" [") + info.unit + "]");
    description.groups.front().parameters.push_back(one);
    append(info.name, kIsSwitch ? T{} : static_cast<T>(info.min), description.min);
    append(info.name, kIsSwitch ? T{1} : static_cast<T>(info.max), description.max);
  });
  return description;
}

}  // namespace ardrone_vslam
