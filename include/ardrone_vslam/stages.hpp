// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <functional>
#include <string>

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

/// What an image can go without when `frame_budget_ms` leaves it no time, the first to go first.
enum class OptionalWork {
  kPlaceSearch,  ///< the flight looked for in a loaded map, or elsewhere in its own
  kLandmarks,    ///< landmarks found, and the correction by them
  kKeyframe      ///< MSCKF: tracks used; the keyframe comes with a later image
};
/// As in Status and summary.json, by the enumerators' order.
constexpr std::array<const char*, 3> kOptionalWorkNames{"place_search", "landmarks", "keyframe"};
/// By OptionalWork.
using LeftOut = std::bitset<kOptionalWorkNames.size()>;
/// Whether that work was.
inline bool isLeftOut(OptionalWork work, const LeftOut& left_out) {
  return left_out[static_cast<std::size_t>(work)];
}
/// A sentence for users, empty where nothing was left out.
std::string explain(const LeftOut& left_out);

/// Milliseconds since the work on a frame began. May be empty: there is as much time as it takes.
using FrameClock = std::function<double()>;

}  // namespace ardrone_vslam
