// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// The parameter tf_prefix of this namespace or the nearest above it; empty where there is none.
std::string tfPrefixOf(const ros::NodeHandle& private_nh);

/// Reads *Config structs from a private namespace. What is not set there keeps the struct's own
/// default; faults are collected and thrown together by `finish`.
class ParamReader {
 public:
  /// @param private_nh  its namespace is searched for keys that are no parameter
  explicit ParamReader(const ros::NodeHandle& private_nh) : nh_(private_nh) {}

  template <class Config>
  void read(Config& config) {
    visitParameters(config,
                    [this](const ParameterInfo& info, auto& value) { readOne(info, value); });
    const auto range_faults = rangeFaults(config);
    faults_.insert(faults_.end(), range_faults.begin(), range_faults.end());
  }

  /// @throws ConfigError listing every fault of every struct that was read.
  void finish() const;

  /// One sentence for each key under the private namespace that no struct has, with the nearest
  /// known name, and for each section beside it whose name is an old one.
  std::vector<std::string> unknownKeys() const;

  /// "name=value name=value ..." of all that was read.
  const std::string& summary() const { return summary_; }

 private:
  template <class T>
  void readOne(const ParameterInfo& info, T& value) {
    known_.insert(info.name);
    XmlRpc::XmlRpcValue given;
    if (nh_.getParam(info.name, given)) {
      if constexpr (std::is_enum_v<T>) {
        readChoice(info, given, value);
      } else if (!convert(given, value)) {
        const bool is_text = std::is_same_v<T, std::string>;
        wrongType(info, given, typeName(value) + (is_text ? std::string(": ") + info.unit : ""));
      }
    }
    summary_ += std::string(summary_.empty() ? "" : " ") + info.name + "=" + textOf(value);
  }

  template <class Enum>
  void readChoice(const ParameterInfo& info, XmlRpc::XmlRpcValue& given, Enum& value) {
    std::string choices;
    std::string name;
    const bool is_text = convert(given, name);
    for (std::size_t i = 0; i < EnumNames<Enum>::kNames.size(); ++i) {
      if (is_text && name == EnumNames<Enum>::kNames[i]) {
        value = static_cast<Enum>(i);
        return;
      }
      choices += std::string(choices.empty() ? "" : ", ") + EnumNames<Enum>::kNames[i];
    }
    wrongType(info, given,
              "one of: " + choices + whatBecameOf(OldName::Kind::kChoice, name, info.name));
  }

  /// @return false when the given value has another type; an integer is a valid double.
  static bool convert(XmlRpc::XmlRpcValue& given, bool& value);
  static bool convert(XmlRpc::XmlRpcValue& given, int& value);
  static bool convert(XmlRpc::XmlRpcValue& given, double& value);
  static bool convert(XmlRpc::XmlRpcValue& given, NumberOrAuto& value);
  static bool convert(XmlRpc::XmlRpcValue& given, std::string& value);
  static const char* typeName(bool) { return "true or false"; }
  static const char* typeName(int) { return "a whole number"; }
  static const char* typeName(double) { return "a number"; }
  static const char* typeName(const NumberOrAuto&) { return "a number or auto"; }
  static const char* typeName(const std::string&) { return "a text"; }

  std::string remedyOf(const std::string& name) const;
  std::vector<std::string> oldSections() const;
  void wrongType(const ParameterInfo& info, XmlRpc::XmlRpcValue& given,
                 const std::string& expected);

  ros::NodeHandle nh_;
  std::set<std::string> known_;
  std::vector<std::string> faults_;
  std::string summary_;
};

}  // namespace ardrone_vslam
