// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "corners/corner_detector.hpp"
#include "measurements.hpp"
#include "pictures.hpp"
#include "timed.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr std::size_t kFrames = 325;  // the thesis's
constexpr int kThreshold = 20;        // halved pictures have lost contrast: 35 leaves few corners
constexpr int kRounds = 3;
constexpr int kPasses = 16;

}  // namespace

nlohmann::json measureSampling(bool quick) {
  std::string what;
  const auto video = smallVideo(quick ? 20 : kFrames, what);
  nlohmann::json json = {{"what", what}, {"frames", video.size()}, {"threshold", kThreshold}};
  for (const auto& [form, set] : {std::pair("scalar", InstructionSet::kScalar),
                                  std::pair("vector", instructionSetInUse().set)}) {
    std::vector<TimedMethod> methods;
    for (int passes = 1; passes <= kPasses; ++passes) {
      CornerDetectorConfig config;
      config.threshold = kThreshold;
      config.adapt_threshold = false;
      config.features_per_frame = 20000;
      config.sampling_passes = passes;
      auto detector = std::make_shared<CornerDetector>(config, set);
      auto corners = std::make_shared<std::vector<Corner>>();
      methods.push_back({"", [=, &video](std::size_t i) {
                           detector->detect(viewOf(video[i]), *corners);
                           return corners->size();
                         }});
    }
    const auto timings = timeMethods(methods, video.size(), quick ? 1 : kRounds);
    for (const Timing& timing : timings)
      json[form].push_back({{"corners", timing.mean_count}, {"time_ms", timing.time_ms}});
  }
  return json;
}

}  // namespace ardrone_vslam::reproduction
