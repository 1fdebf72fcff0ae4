// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// The part of YAML that config/*.yaml and camera calibrations are written in: `key: value` and
/// sections of them, one level deep, values that are scalars or lists of scalars in brackets (also
/// over several lines), comments, quotes. What goes beyond is a fault, not a guess.
/// Keys outside of any section are in the section "".
/// Not yaml-cpp: for the drone it would have to be built, too, and linked with iostreams into a
/// program that is the core and the C library alone.
using YamlSections = std::map<std::string, std::map<std::string, std::string>>;

/// @param faults  gets a sentence for each line that cannot be read
YamlSections readYamlSections(const std::string& text, std::vector<std::string>& faults);
/// Of a file; the sentences name it.
YamlSections readYamlFile(const std::string& path, std::vector<std::string>& faults);

/// The scalars of a value in brackets; a value without them is a list of one.
std::vector<std::string> listOf(const std::string& value);

/// A number, the whole text. @return false when it is none
bool toNumber(const std::string& text, double& value);
bool toNumber(const std::string& text, int& value);
/// As YAML 1.1 has it: true, yes, on, y and their opposites.
bool toSwitch(const std::string& text, bool& value);

}  // namespace ardrone_vslam
