// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/collection/running_configuration.hpp"

#include <ros/master.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <sstream>
#include <string>
#include <vector>

namespace ardrone_vslam {
namespace {

/// Private namespaces of the mappers: only they have this service. Parameters alone stay when a
/// node has ended.
std::vector<std::string> runningMappers() {
  const std::string service = "/save_map";
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  std::vector<std::string> mappers;
  if (!ros::master::execute("getSystemState", request, response, state, false)) return mappers;
  XmlRpc::XmlRpcValue& services = state[2];
  for (int i = 0; i < services.size(); ++i) {
    const std::string name = services[i][0];
    if (name.size() <= service.size()) continue;
    const std::size_t at = name.size() - service.size();
    if (name.substr(at) == service) mappers.push_back(name.substr(0, at));
  }
  return mappers;
}

/// As a configuration file writes it.
std::string textOf(const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue copy = value;
  if (copy.getType() == XmlRpc::XmlRpcValue::TypeString) return copy;
  if (copy.getType() == XmlRpc::XmlRpcValue::TypeBoolean)
    return static_cast<bool>(copy) ? "true" : "false";
  std::ostringstream text;
  copy.write(text);
  return text.str();
}

}  // namespace

DoctorConfiguration runningConfiguration() {
  const std::vector<std::string> mappers = runningMappers();
  if (mappers.size() != 1) return {};
  const std::string mapper = mappers.front();
  const std::string tracker = ros::names::append(ros::names::parentNamespace(mapper), "tracker");
  const auto value = [=](const std::string& section,
                         const std::string& key) -> std::optional<std::string> {
    XmlRpc::XmlRpcValue set;
    if (!ros::param::get(ros::names::append(section == "tracker" ? tracker : mapper, key), set))
      return std::nullopt;
    return textOf(set);
  };
  return {mapper, value};
}

}  // namespace ardrone_vslam
