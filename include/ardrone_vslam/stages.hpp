// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace ardrone_vslam {

/// The stages whose cost is reported. The core reads no clock: it tells a hook which stage begins,
/// the caller times.
enum class Stage { kDetect, kDescribe, kTrack, kAssociate, kLocalise, kMap, kIdle };
constexpr std::size_t kStageCount = 6;  ///< stages with a cost; kIdle is the end of work
constexpr std::array<const char*, kStageCount> kStageNames{"detect",    "describe", "track",
                                                           "associate", "localise", "map"};

/// Called when a stage begins, with kIdle when the work on a frame is done. May be empty.
using StageHook = std::function<void(Stage)>;

}  // namespace ardrone_vslam
