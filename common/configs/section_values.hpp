// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "ardrone_vslam/parameters.hpp"
#include "files/shortened.hpp"

namespace ardrone_vslam {

/// A visitor for visitParameters() that takes the values out of a section of a configuration file,
/// parameter by parameter: what is left over is unknown. Ranges are rangeFaults()'s.
/// @tparam ReadScalar  bool(const std::string& text, T& value) for T = bool, int, double; false
///   when the text is none
template <class ReadScalar>
struct SectionValues {
  std::string section_name;                    ///< for messages
  std::map<std::string, std::string>* values;  ///< key -> value as written
  std::vector<std::string>* faults;            ///< receives a message for each value that is none
  ReadScalar read_scalar{};                    ///< the file format's own reading

  /// Leaves `value` as it is when the section has none, or none that can be read.
  template <class T>
  void operator()(const ParameterInfo& info, T& value) const {
    const auto entry = values->find(info.name);
    if (entry == values->end()) return;
    const std::string text = entry->second;
    values->erase(entry);
    std::string must_be;
    if constexpr (std::is_enum_v<T>) {
      if (readChoice(text, value, must_be)) return;
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = text;
      return;
    } else {
      if (!isOctal(text) && readNumber(text, value)) return;
      must_be = std::string(kindOf(value)) + " [" + info.unit + "]" +
                (isOctal(text) ? " without zeros before it" : "");
    }
    faults->push_back(section_name + "/" + info.name + " is '" + shortened(text) +
                      "' but must be " + must_be +
                      whatBecameOf(OldName::Kind::kChoice, text, info.name));
  }

 private:
  /// roslaunch and yaml-cpp read 010 as 8, others as 10.
  static bool isOctal(const std::string& text) {
    const std::size_t begin = text.find_first_not_of("+-");
    return begin != std::string::npos && text.size() > begin + 1 && text[begin] == '0' &&
           text.find_first_not_of("0123456789", begin) == std::string::npos;
  }

  static const char* kindOf(bool) { return "a switch (true or false)"; }
  static const char* kindOf(int) { return "a whole number"; }
  static const char* kindOf(double) { return "a number"; }
  static const char* kindOf(const NumberOrAuto&) { return "a number or auto"; }

  template <class T>
  bool readNumber(const std::string& text, T& value) const {
    return read_scalar(text, value);
  }
  bool readNumber(const std::string& text, NumberOrAuto& value) const {
    double number = 0;
    const bool is_auto = text == kAuto;
    if (!is_auto && !read_scalar(text, number)) return false;
    value = is_auto ? NumberOrAuto{} : number;
    return true;
  }

  template <class Enum>
  static bool readChoice(const std::string& text, Enum& value, std::string& must_be) {
    for (std::size_t i = 0; i < EnumNames<Enum>::kNames.size(); ++i) {
      if (text == EnumNames<Enum>::kNames[i]) {
        value = static_cast<Enum>(i);
        return true;
      }
      must_be += (must_be.empty() ? "one of: " : ", ") + std::string(EnumNames<Enum>::kNames[i]);
    }
    return false;
  }
};

}  // namespace ardrone_vslam
