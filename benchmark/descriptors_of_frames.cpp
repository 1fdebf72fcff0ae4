// SPDX-License-Identifier: BSD-3-Clause
#include "descriptors_of_frames.hpp"

#include <map>
#include <memory>

#include "ardrone_vslam/tracker.hpp"
#include "frames.hpp"
#include "sequences/sequence.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr std::size_t kQueries = 1000;
constexpr std::size_t kQueryInterval_frames = 10;

std::unique_ptr<Sequence> longSequence() {
  if (const auto folder = dataFolder()) return openFolder(*folder + "/kitti_03");
  return std::make_unique<WorldSequence>(WorldOptions{});
}

}  // namespace

const MapDescriptors& mapDescriptors(std::size_t size) {
  static std::map<std::size_t, MapDescriptors> made;
  MapDescriptors& result = made[size];
  if (!result.map.empty()) return result;
  const auto sequence = longSequence();
  // All frames but every tenth, with as many features as fill the map.
  const std::size_t map_frames = sequence->size() - sequence->size() / kQueryInterval_frames;
  TrackerConfig config;
  config.corners.features_per_frame = static_cast<int>(2 * size / map_frames + 100);
  Tracker tracker(config, sequence->camera());
  ImageFeatures features;
  for (std::size_t i = 0; i < sequence->size(); ++i) {
    const cv::Mat image = sequence->image(i);
    tracker.process({image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)},
                    static_cast<std::int64_t>(i + 1), features);
    auto& into = i % kQueryInterval_frames == kQueryInterval_frames - 1 ? result.query : result.map;
    into.insert(into.end(), features.descriptor.begin(), features.descriptor.end());
  }
  // Thinned evenly, so that the whole sequence stays in it.
  const auto thin = [](std::vector<Descriptor>& all, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) all[k] = all[k * all.size() / count];
    all.resize(count);
  };
  thin(result.map, std::min(size, result.map.size()));
  thin(result.query, std::min(kQueries, result.query.size()));
  return result;
}

}  // namespace ardrone_vslam::bench
