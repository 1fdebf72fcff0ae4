// SPDX-License-Identifier: BSD-3-Clause
#include "program/tool_main.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <new>
#include <opencv2/core.hpp>
#include <system_error>

#include "ardrone_vslam/instruction_set.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

namespace {

constexpr const char* kNoMemory =
    "there is not enough memory; end other programs, or use fewer or smaller images";

/// What became of options and values of earlier versions that the arguments hold.
std::vector<std::string> oldArguments(int argc, char** argv) {
  std::vector<std::string> sentences;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string option = argument.substr(0, argument.find('='));
    const std::string before = std::string(argv[i - 1]).substr(0, 2) == "--" ? argv[i - 1] + 2 : "";
    for (const OldName& old : oldNames()) {
      const bool is_option = old.kind == OldName::Kind::kOption && option == old.name;
      const bool is_choice =
          old.kind == OldName::Kind::kChoice && before == old.owner && argument == old.name;
      if (!is_option && !is_choice) continue;
      sentences.push_back(std::string(old.name) + " is called " + old.now + " now");
      break;
    }
  }
  return sentences;
}

/// @return false when it is no whole number from 0 or does not fit
bool readWhole(const std::string& text, std::uint64_t& number) {
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end;
}

std::string sentenceOf(const std::exception& e) {
  const auto* opencv = dynamic_cast<const cv::Exception*>(&e);
  const bool has_no_memory = dynamic_cast<const std::bad_alloc*>(&e) != nullptr ||
                             (opencv != nullptr && opencv->code == cv::Error::StsNoMem);
  if (has_no_memory) return kNoMemory;
  return opencv != nullptr ? opencv->err : e.what();
}

/// What stood in a buffer and did not get out would be lost in silence.
bool isWritten(const CLI::App& app) {
  const bool is_good = std::cout.flush().good() && std::fflush(stdout) == 0 && !std::ferror(stdout);
  if (!is_good)
    std::cerr << app.get_name() << ": the output cannot be written; check the free space\n";
  return is_good;
}

}  // namespace

int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& run) {
  const auto fault = [&app](const std::exception& e, int exit_code) {
    std::cerr << app.get_name() << ": " << sentenceOf(e) << '\n';
    return exit_code;
  };
  // What OpenCV throws is told here, once and in our words.
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  try {
    app.parse(argc, argv);
    const std::string& kernels_fault = instructionSetInUse().fault;
    if (!kernels_fault.empty()) std::cerr << app.get_name() << ": " << kernels_fault << '\n';
    const int code = run();
    return isWritten(app) ? code : 1;
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) == 0) return isWritten(app) ? 0 : 1;
    for (const std::string& sentence : oldArguments(argc, argv))
      std::cerr << app.get_name() << ": " << sentence << '\n';
    return 2;
  } catch (const UsageError& e) {
    return fault(e, 2);
  } catch (const std::exception& e) {
    return fault(e, 1);
  }
}

CLI::Validator numberWithin(double least, double most) {
  const CLI::Range range(least, most);
  const auto fault = [range](std::string& text) {
    const bool is_nan = std::isnan(std::strtod(text.c_str(), nullptr));
    return is_nan ? "'" + text + "' must be a number" : range(text);
  };
  return CLI::Validator(fault, range.get_description());
}

CLI::Option* addSeed(CLI::App& app, const std::string& name, std::uint64_t& seed,
                     const std::string& what) {
  const auto faultOf = [](const std::string& text) {
    std::uint64_t number = 0;
    return readWhole(text, number) ? std::string()
                                   : "'" + text + "' must be a whole number from 0 below 2^64";
  };
  return app.add_option(name, seed, what)
      ->capture_default_str()
      ->check(CLI::Validator(faultOf, "", "seed"));
}

std::vector<std::uint64_t> parseSeeds(const std::string& text) {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  const auto colon = text.find(':');
  if (colon == std::string::npos || !readWhole(text.substr(0, colon), first) ||
      !readWhole(text.substr(colon + 1), last) || last < first || last - first > 9999) {
    throw UsageError("--seeds: '" + text +
                     "' must be A:B with 0 <= A <= B, at most 10000 seeds, for example 1:5");
  }
  std::vector<std::uint64_t> seeds;
  // By count: the largest seed has no successor.
  for (std::uint64_t i = 0; i <= last - first; ++i) seeds.push_back(first + i);
  return seeds;
}

}  // namespace ardrone_vslam
