// SPDX-License-Identifier: BSD-3-Clause
#include "track_sequences.hpp"

#include <algorithm>

#include "frames.hpp"
#include "sequences/drone_cameras.hpp"
#include "sequences/sequence.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam::bench {
namespace {

TrueSequence imagesOf(Sequence& sequence, const FrameSelection& selection) {
  TrueSequence result;
  result.camera = sequence.camera();
  const std::size_t end = std::min(sequence.size(), selection.end.value_or(sequence.size()));
  for (std::size_t i = selection.begin; i < end; i += selection.step) {
    result.images.push_back(sequence.image(i));
    result.T_world_cam.push_back(sequence.truth().at(sequence.stamp_ns(i)) * sequence.T_base_cam());
  }
  return result;
}

/// @param begin_s, end_s  of the flight
SequenceChoice rendered(const std::string& flight, std::size_t begin_s, std::size_t end_s,
                        const std::string& camera = "front") {
  constexpr std::size_t kRate_hz = 20;
  const auto load = [=] {
    WorldOptions options;
    options.flight = flight;
    options.rate_hz = kRate_hz;
    options.duration_s = static_cast<double>(end_s);
    options.camera = cameraNamed(camera).intrinsics;
    options.T_body_cam = options.T_base_cam = cameraNamed(camera).T_body_cam;
    options.effects.shutter_s = flightInfo(flight).shutter_s;
    options.effects.readout_s = flightInfo(flight).readout_s;
    WorldSequence world(options);
    FrameSelection selection;
    selection.begin = begin_s * kRate_hz;
    return imagesOf(world, selection);
  };
  return {"rendered: " + flight + (camera == "front" ? "" : ", " + camera + " camera"), load};
}

SequenceChoice recorded(const std::string& name, std::size_t end, std::size_t step = 1) {
  const auto load = [=] {
    FrameSelection selection;
    selection.end = end;
    selection.step = step;
    return imagesOf(*openFolder(*dataFolder() + "/" + name), selection);
  };
  return {step == 1 ? name : name + ", every " + std::to_string(step) + "th", load};
}

}  // namespace

std::vector<SequenceChoice> trackSequences(bool is_quick) {
  if (is_quick) return {rendered("laps", 2, 3)};
  // Flights begin at rest, and fast_blur is fast from 20 s on.
  std::vector<SequenceChoice> choices = {rendered("laps", 2, 6), rendered("laps", 2, 8, "bottom"),
                                         rendered("corridor", 2, 6), rendered("fast_blur", 20, 24)};
  if (!dataFolder()) return choices;
  choices.push_back(recorded("kitti_03", 120));
  choices.push_back(recorded("kitti_00_clip", 100));
  choices.push_back(recorded("seven_scenes_kitchen", 200));
  choices.push_back(recorded("seven_scenes_kitchen", 200, 4));
  return choices;
}

}  // namespace ardrone_vslam::bench
