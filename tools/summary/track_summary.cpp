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
