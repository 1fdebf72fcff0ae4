// SPDX-License-Identifier: BSD-3-Clause
#include "summary/track_summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

/// Null where there are none.
Json share(double part, double of) {
  return of > 0 && std::isfinite(part) ? Json(part / of) : Json(nullptr);
}

}  // namespace

void addLearnedNoise(const RunResult& run, Json& summary) {
  const FrameResult last = run.frames.empty() ? FrameResult{} : run.frames.back().result;
  const auto orUnknown = [](double x) {
    return x > 0 && std::isfinite(x) ? Json(x) : Json(nullptr);
  };
  summary["velocity_bias_learned_m_s"] = orUnknown(last.velocity_bias_sigma_m_s);
  summary["yaw_walk_learned_over_configured"] = orUnknown(last.yaw_walk_factor);
}

void addTracks(const RunResult& run, Json& summary) {
  double tracks = 0;
  double aligned = 0;
  double nis = 0;
  int keyframes = 0;
  for (const RunFrame& frame : run.frames) {
    tracks += frame.result.tracks;
    aligned += frame.result.tracks_aligned;
    nis += frame.result.track_nis;
    keyframes += frame.result.track_nis != 0 ? 1 : 0;
  }
  summary["tracks_aligned_share"] = share(aligned, tracks);
  summary["track_nis_mean"] = share(nis, keyframes);
}

}  // namespace ardrone_vslam
