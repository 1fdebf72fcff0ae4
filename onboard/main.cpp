// SPDX-License-Identifier: BSD-3-Clause
// vslam_onboard: images and the controller's observer in, fused poses out, on the drone itself.
// docs/onboard.md
#include <getopt.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "ardrone_vslam/instruction_set.hpp"
#include "loop/onboard_loop.hpp"
#include "loop/self_test.hpp"
#include "loop/stop_signal.hpp"
#include "program_memory.hpp"
#include "settings/settings.hpp"

namespace {

using namespace ardrone_vslam;

constexpr int kFault = 1;
constexpr int kWrongUse = 2;

constexpr const char* kUsage =
    "usage: vslam_onboard --config FILE [--frames SOURCE] [--camera FILE] [--observer FILE]\n"
    "                     [--poses FILE] [--map FILE] [--save-map FILE] [--priority NICE]\n"
    "                     [--cpu-share RATIO] [--every-frame] [--set SECTION/KEY=VALUE]...\n"
    "                     [--self-test] [--version]\n"
    "Poses from a camera and a flight controller's observer, on the drone (docs/onboard.md).\n"
    "  --config     yaml with the sections onboard, tracker and mapper (docs/parameters.md)\n"
    "  --self-test  check processor, clock, kernels, memory and camera; exit code 1 if one fails\n"
    "  --map        map file of an earlier flight, in whose map this one takes place\n"
    "  --save-map   file that gets this flight's map, every autosave_s and at the end\n"
    "  --poses      file that gets the answers, too\n"
    "  --every-frame  no image is dropped for a newer one (a FIFO; files never drop any)\n"
    "The other options are parameters, too. SIGTERM ends it and saves the map.\n";

struct Arguments {
  std::string config;
  std::vector<std::string> overrides;
  std::string poses;
  bool every_frame = false;
  bool is_self_test = false;
};

/// Section and name of the parameter that an option gives.
std::string parameterOf(std::string name) {
  if (name == "map") return "mapper/map_file";
  std::replace(name.begin(), name.end(), '-', '_');
  return (name == "save_map" ? "mapper/" : "onboard/") + name;
}

/// @return an exit code to end with, negative to go on
int parse(int argc, char** argv, Arguments& arguments) {
  // Values above any letter: options that are parameters.
  enum { kConfig = 256, kSet, kSelfTest, kVersion, kHelp, kEveryFrame, kPoses, kParameter };
  static const option options[] = {{"config", required_argument, nullptr, kConfig},
                                   {"set", required_argument, nullptr, kSet},
                                   {"self-test", no_argument, nullptr, kSelfTest},
                                   {"version", no_argument, nullptr, kVersion},
                                   {"help", no_argument, nullptr, kHelp},
                                   {"every-frame", no_argument, nullptr, kEveryFrame},
                                   {"frames", required_argument, nullptr, kParameter},
                                   {"camera", required_argument, nullptr, kParameter},
                                   {"observer", required_argument, nullptr, kParameter},
                                   {"poses", required_argument, nullptr, kPoses},
                                   {"map", required_argument, nullptr, kParameter},
                                   {"save-map", required_argument, nullptr, kParameter},
                                   {"priority", required_argument, nullptr, kParameter},
                                   {"cpu-share", required_argument, nullptr, kParameter},
                                   {nullptr, 0, nullptr, 0}};
  int which = 0;
  for (int c; (c = ::getopt_long(argc, argv, "h", options, &which)) != -1;) {
    switch (c) {
      case 'h':
      case kHelp:
        std::fputs(kUsage, stdout);
        return 0;
      case kVersion:
        std::puts("vslam_onboard (ardrone_vslam) " ARDRONE_VSLAM_VERSION);
        return 0;
      case kConfig:
        arguments.config = optarg;
        break;
      case kSet:
        arguments.overrides.emplace_back(optarg);
        break;
      case kSelfTest:
        arguments.is_self_test = true;
        break;
      case kEveryFrame:
        arguments.every_frame = true;
        break;
      case kPoses:
        arguments.poses = optarg;
        break;
      case kParameter:
        arguments.overrides.push_back(parameterOf(options[which].name) + "=" + optarg);
        break;
      default:
        std::fputs(kUsage, stderr);
        return kWrongUse;
    }
  }
  if (optind == argc) return -1;
  std::fprintf(stderr, "vslam_onboard: unexpected '%s'\n%s", argv[optind], kUsage);
  return kWrongUse;
}

void takeMemoryFor(const Settings& settings) {
  takeMemory(memory_bytes(settings), settings.onboard.lock_memory);
}

int run(const Settings& settings) {
  if (::setpriority(PRIO_PROCESS, 0, settings.onboard.priority) != 0)
    std::fprintf(stderr, "vslam_onboard: priority %d is refused: %s\n", settings.onboard.priority,
                 std::strerror(errno));
  OnboardLoop loop(settings, installStopSignal());
  const bool is_good = loop.run();
  loop.printSummary();
  std::string said;
  bool is_saved = true;
  try {
    said = loop.saveMap();
  } catch (const MapFileError& e) {
    said = e.what();
    is_saved = false;
  }
  if (!said.empty()) std::fprintf(stderr, "vslam_onboard: %s\n", said.c_str());
  const MemoryUse memory = memoryUse();
  std::fprintf(stderr, "vslam_onboard: of %.1f MB of memory at most %.1f were in use\n",
               static_cast<double>(memory.capacity_bytes) / 1e6,
               static_cast<double>(memory.most_bytes) / 1e6);
  return is_good && is_saved ? 0 : kFault;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments;
    const int exit_code = parse(argc, argv, arguments);
    if (exit_code >= 0) return exit_code;
    const std::string& kernels_fault = instructionSetInUse().fault;
    if (!kernels_fault.empty()) std::fprintf(stderr, "vslam_onboard: %s\n", kernels_fault.c_str());
    Settings settings = loadSettings(arguments.config, arguments.overrides);
    settings.onboard.every_frame = arguments.every_frame;
    settings.onboard.poses = arguments.poses;
    takeMemoryFor(settings);
    if (arguments.is_self_test) return selfTest(settings) ? 0 : kFault;
    return run(settings);
  } catch (const std::bad_alloc&) {
    std::fputs("vslam_onboard: out of memory: set onboard/working_mb higher\n", stderr);
  } catch (const ConfigError& e) {
    std::fprintf(stderr, "vslam_onboard: %s\n", e.what());
    return kWrongUse;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "vslam_onboard: %s\n", e.what());
  }
  return kFault;
}
