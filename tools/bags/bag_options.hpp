// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bags/bag_sequence.hpp"
#include "config_files/config_file.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
class Option;
}  // namespace CLI

namespace ardrone_vslam {

/// The command line's options for reading a bag.
class BagOptions {
 public:
  void addTo(CLI::App& app);
  /// @throws UsageError naming the options that were given although the input is a folder
  void refuseForFolder(const std::string& folder) const;
  /// @param config  says what the command line does not. @throws std::runtime_error for a wrong
  /// --camera file
  BagReadOptions read(const PipelineConfig& config) const;

 private:
  BagReadOptions bag_;
  std::string camera_yaml_;
  std::vector<const CLI::Option*> options_;
};

}  // namespace ardrone_vslam
