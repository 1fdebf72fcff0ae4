// SPDX-License-Identifier: BSD-3-Clause
#include "with_ros/params.hpp"

#include <ros/names.h>
#include <ros/param.h>

namespace ardrone_vslam {
namespace {

/// Keys that ROS itself puts under a node's private namespace.
const std::set<std::string>& keysOfRos() {
  static const std::set<std::string> kKeys{"diagnostic_period", "num_worker_threads", "tf_prefix"};
  return kKeys;
}

std::string textOf(XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) return static_cast<std::string>(value);
  std::ostringstream text;
  value.write(text);
  return text.str();
}

}  // namespace

std::string tfPrefixOf(const ros::NodeHandle& private_nh) {
  std::string key;
  std::string prefix;
  if (private_nh.searchParam("tf_prefix", key)) private_nh.getParam(key, prefix);
  return prefix;
}

bool ParamReader::convert(XmlRpc::XmlRpcValue& given, bool& value) {
  if (given.getType() != XmlRpc::XmlRpcValue::TypeBoolean) return false;
  value = static_cast<bool>(given);
  return true;
}

bool ParamReader::convert(XmlRpc::XmlRpcValue& given, int& value) {
  if (given.getType() != XmlRpc::XmlRpcValue::TypeInt) return false;
  value = static_cast<int>(given);
  return true;
}

bool ParamReader::convert(XmlRpc::XmlRpcValue& given, double& value) {
  int whole = 0;
  if (convert(given, whole)) {
    value = whole;
    return true;
  }
  if (given.getType() != XmlRpc::XmlRpcValue::TypeDouble) return false;
  value = static_cast<double>(given);
  return true;
}

bool ParamReader::convert(XmlRpc::XmlRpcValue& given, NumberOrAuto& value) {
  double number = 0;
  std::string text;
  const bool is_auto = convert(given, text) && text == kAuto;
  if (!is_auto && !convert(given, number)) return false;
  value = is_auto ? NumberOrAuto{} : number;
  return true;
}

bool ParamReader::convert(XmlRpc::XmlRpcValue& given, std::string& value) {
  if (given.getType() != XmlRpc::XmlRpcValue::TypeString) return false;
  value = static_cast<std::string>(given);
  return true;
}

void ParamReader::wrongType(const ParameterInfo& info, XmlRpc::XmlRpcValue& given,
                            const std::string& expected) {
  faults_.push_back(nh_.resolveName(info.name) + " is '" + textOf(given) + "' but must be " +
                    expected);
}

void ParamReader::finish() const {
  if (!faults_.empty()) throw ConfigError(faults_);
}

std::string ParamReader::remedyOf(const std::string& name) const {
  std::string became = whatBecameOf(OldName::Kind::kParameter, name);
  if (!became.empty()) return became;
  const std::string nearest = nearestName(name, known_);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::vector<std::string> ParamReader::oldSections() const {
  std::vector<std::string> sentences;
  const std::string above = ros::names::parentNamespace(nh_.getNamespace());
  for (const OldName& old : oldNames()) {
    const std::string section = ros::names::append(above, old.name);
    if (old.kind != OldName::Kind::kSection || !ros::param::has(section)) continue;
    sentences.push_back(section + " is not a section and has no effect" +
                        whatBecameOf(old.kind, old.name));
  }
  return sentences;
}

std::vector<std::string> ParamReader::unknownKeys() const {
  std::vector<std::string> all;
  std::vector<std::string> sentences;
  if (!nh_.getParamNames(all)) return sentences;
  const std::string prefix = nh_.getNamespace() + "/";
  for (const auto& full_name : all) {
    if (full_name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string name = full_name.substr(prefix.size());
    if (known_.count(name) > 0 || keysOfRos().count(name) > 0) continue;
    sentences.push_back(full_name + " is not a parameter and has no effect" + remedyOf(name) +
                        " (docs/parameters.md lists all)");
  }
  const std::vector<std::string> old = oldSections();
  sentences.insert(sentences.end(), old.begin(), old.end());
  return sentences;
}

}  // namespace ardrone_vslam
