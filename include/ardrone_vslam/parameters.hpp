// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace ardrone_vslam {

/// Where docs/parameters.md lists a parameter.
enum class PagePart {
  kUser,      ///< on its first part
  kAdvanced,  ///< behind it
  kThesis     ///< of `estimator: thesis` alone
};

/// And at which place there: the user's are ordered by what to turn first.
struct PagePlace {
  PagePart part = PagePart::kAdvanced;  ///< of the page
  int rank = 0;                         ///< the others are in the order of the structs
};

/// One of the first part. @param rank  from 1 on
constexpr PagePlace turnFirst(int rank) {
  return {PagePart::kUser, rank};
}
/// One of another part.
constexpr PagePlace ofPart(PagePart part) {
  return {part, 0};
}

/// A number, or nothing, which is `auto` in yaml files: the program finds it by itself.
using NumberOrAuto = std::optional<double>;
constexpr const char* kAuto = "auto";  ///< its word

/// What a user needs to know of one parameter. Its default is the value in the freshly constructed
/// struct, so that it is written only once.
///
/// Every *Config struct S of the project that has parameters has a free function
/// @code
/// template <class Visitor> void visitParameters(S& config, Visitor&& visit);
/// @endcode
/// that calls visit(const ParameterInfo&, member) for each parameter, nested structs included: an
/// int, double, NumberOrAuto, bool, string or an enumeration with EnumNames. Reading, validation,
/// listing and the documentation all use it. Members that it leaves out, and structs without it,
/// are no parameters: only tests and benchmarks give them other values.
struct ParameterInfo {
  const char* name;  ///< as in yaml files and in messages
  const char* unit;  ///< "px", "m", "rad", "-" ...; "choice" for enumerations, "switch" for bool
  double min;  ///< smallest and largest valid value of a number; unused for choices and switches
  double max;  ///< likewise
  const char* effect;    ///< complete in itself, for docs/parameters.md and --list-parameters
  PagePlace place = {};  ///< there
};

/// Specialised for every enumeration that is a parameter: `static constexpr std::array<const char*,
/// N> kNames`, in the order of the enumerators, which count from 0.
template <class Enum>
struct EnumNames;

/// The word for a choice in yaml files and messages.
template <class Enum>
const char* nameOf(Enum value) {
  return EnumNames<Enum>::kNames[static_cast<std::size_t>(value)];
}

/// A parameter's value as yaml files have it.
template <class T>
std::string textOf(const T& value) {
  std::ostringstream text;
  if constexpr (std::is_enum_v<T>) {
    text << nameOf(value);
  } else if constexpr (std::is_same_v<T, NumberOrAuto>) {
    value ? text << *value : text << kAuto;
  } else {
    text << std::boolalpha << value;
  }
  return text.str();
}

/// Thrown once at construction or loading; lists every fault of the configuration.
class ConfigError : public std::runtime_error {
 public:
  /// what() has all of them, one a line.
  explicit ConfigError(const std::vector<std::string>& faults);
  /// One sentence each.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

/// What the templates in the headers need.
namespace detail {
/// Visitor that notes the numbers outside their range.
struct RangeCheck {
  std::vector<std::string>* faults;  ///< receives one sentence for each

  /// Looks at numbers; choices and switches cannot be outside.
  template <class T>
  void operator()(const ParameterInfo& info, T& value) const {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      check(info, static_cast<double>(value));
    } else if constexpr (std::is_same_v<T, NumberOrAuto>) {
      if (value) check(info, *value);
    }
  }
  /// Notes the fault of one number; NaN is outside.
  void check(const ParameterInfo& info, double value) const;
};
}  // namespace detail

/// @return one sentence for each parameter outside its range (name, value, range); empty when all
/// are valid.
template <class Config>
std::vector<std::string> rangeFaults(Config config) {
  std::vector<std::string> faults;
  visitParameters(config, detail::RangeCheck{&faults});
  return faults;
}

/// @throws ConfigError listing every parameter of `config` that is outside its range.
template <class Config>
void validate(const Config& config) {
  const auto faults = rangeFaults(config);
  if (!faults.empty()) throw ConfigError(faults);
}

/// A name of earlier versions, which is refused with what became of it.
struct OldName {
  /// What it was the name of.
  enum class Kind { kParameter, kChoice, kSection, kOption, kLaunchArgument, kNode };
  Kind kind;  ///< of these
  /// The section of a parameter, the parameter of a choice, the program of an option, the file of a
  /// launch argument.
  const char* owner;
  const char* name;  ///< the old one
  const char* now;   ///< empty when nothing has taken its place
  const char* why;   ///< empty, or why it is a constant now, or what is different
};

/// All of them.
const std::vector<OldName>& oldNames();
/// The sentence for a message that refuses it, beginning with "; ". Empty when the name never was
/// one. @param owner  empty: any
std::string whatBecameOf(OldName::Kind kind, const std::string& name,
                         const std::string& owner = "");
/// The end of a message that refuses a parameter of a section: what became of it, or the nearest
/// known name.
std::string remedyFor(const std::string& section, const std::string& written,
                      const std::set<std::string>& known);

/// For the message that refuses an unknown name.
/// @return the known name that takes the fewest letters to insert, remove or replace to become
/// `written`, or contains it; empty when none is similar.
std::string nearestName(const std::string& written, const std::set<std::string>& known);

}  // namespace ardrone_vslam
