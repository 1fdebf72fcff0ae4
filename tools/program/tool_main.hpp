// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
class Option;
class Validator;
}  // namespace CLI

namespace ardrone_vslam {

/// Arguments that are wrong or do not fit each other: exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What all tools' main() do: parses the arguments, calls `run`, and prints what either throws as
/// "name: message".
/// @param app  carries the tool's name
/// @return `run`'s answer; 0 for --help and the like; 2 for wrong usage; 1 for every other fault,
/// and where the output cannot be written (a full disk)
int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& run);

/// Calls `read`, for which std::invalid_argument means that what the user gave cannot be.
/// @throws UsageError with that message
template <class Read>
auto asUsage(const Read& read) {
  try {
    return read();
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

/// A number between these: CLI11's own Range lets NaN pass.
CLI::Validator numberWithin(double least, double most);

/// An option for a random generator's seed: a whole number from 0 below 2^64, as CLI11 alone takes
/// -1 and what is too large for 2^64 - 1.
CLI::Option* addSeed(CLI::App& app, const std::string& name, std::uint64_t& seed,
                     const std::string& what);

/// The seeds of --seeds A:B. @throws UsageError saying what is wrong
std::vector<std::uint64_t> parseSeeds(const std::string& text);

}  // namespace ardrone_vslam
