// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "parameters/parameter_values.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// The parameters of a *Config struct may change in flight, by the service and the topics that
/// rqt_reconfigure and dynparam know (dynamic_reconfigure, whose server would need a generated
/// class that repeats names, ranges and texts).
template <class Config>
class ParameterChanges {
 public:
  /// Takes valid values over. @throws ConfigError where they do not fit what else is set, which
  /// refuses them
  using Use = std::function<void(const Config&)>;

  /// @param config  as at the start
  ParameterChanges(const ros::NodeHandle& private_nh, const Config& config, Warnings& warnings,
                   Use use)
      : nh_(private_nh),
        config_(config),
        at_start_(textsOf(config)),
        warnings_(warnings),
        use_(std::move(use)),
        descriptions_(nh_.advertise<dynamic_reconfigure::ConfigDescription>(
            "parameter_descriptions", 1, true)),
        updates_(nh_.advertise<ParameterValues>("parameter_updates", 1, true)),
        service_(nh_.advertiseService("set_parameters", &ParameterChanges::change, this)) {
    descriptions_.publish(descriptionOf<Config>());
    updates_.publish(valuesOf(config_));
  }

  /// "name=value" of each that is not as at the start.
  const std::string& changed() const { return changed_; }

 private:
  bool change(dynamic_reconfigure::Reconfigure::Request& request,
              dynamic_reconfigure::Reconfigure::Response& response) {
    Config wanted = config_;
    try {
      const std::vector<std::string> faults = takeOver(request.config, wanted);
      if (!faults.empty()) throw ConfigError(faults);
      if (textsOf(wanted) != textsOf(config_)) use(wanted);
    } catch (const std::exception& e) {
      const std::string why = std::string("no parameter is changed: ") + e.what();
      warnings_.say(why);
      throw std::runtime_error(why);  // which goes to who has called
    }
    response.config = valuesOf(config_);
    return true;
  }

  /// The master knows them, too, so that a nodelet that begins again begins with them.
  void use(const Config& wanted) {
    use_(wanted);
    const std::map<std::string, std::string> before = textsOf(config_);
    config_ = wanted;
    visitParameters(config_, [&](const ParameterInfo& info, auto& value) {
      if (textOf(value) != before.at(info.name)) nh_.setParam(info.name, value);
    });
    changed_.clear();
    for (const auto& [name, value] : textsOf(config_)) {
      if (value != at_start_.at(name))
        changed_ += (changed_.empty() ? "" : " ") + name + "=" + value;
    }
    updates_.publish(valuesOf(config_));
    warnings_.say("changed in flight: " + (changed_.empty() ? "nothing any more" : changed_));
  }

  static std::map<std::string, std::string> textsOf(Config config) {
    std::map<std::string, std::string> texts;
    visitParameters(config, [&](const ParameterInfo& info, auto& value) {
      texts.emplace(info.name, textOf(value));
    });
    return texts;
  }

  ros::NodeHandle nh_;
  Config config_;
  std::map<std::string, std::string> at_start_;
  std::string changed_;
  Warnings& warnings_;
  Use use_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace ardrone_vslam
