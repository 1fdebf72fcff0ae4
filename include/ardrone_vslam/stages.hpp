// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace ardrone_vslam {

/// The stages whose cost is reported. The core reads no clock: it tells a hook which stage begins,
/// the caller times.
enum class Stage {
  kDetect,     ///< corners and their bearings
  kDescribe,   ///< descriptors
  kTrack,      ///< tracks from image to image
  kAssociate,  ///< landmarks and map features found
  kLocalise,   ///< prediction, tracks and fixes
  kMap,        ///< landmarks made, refined, removed
  kIdle        ///< work on the frame is done
};
constexpr std::size_t kStageCount = 6;  ///< stages with a cost; kIdle is the end of work
/// As in Status and frames.csv, by the enumerators' order.
constexpr std::array<const char*, kStageCount> kStageNames{"detect",    "describe", "track",
                                                           "associate", "localise", "map"};

/// Called when a stage begins, with kIdle when the work on a frame is done. May be empty.
using StageHook = std::function<void(Stage)>;

}  // namespace ardrone_vslam
