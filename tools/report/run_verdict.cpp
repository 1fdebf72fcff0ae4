// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace ardrone_vslam {
namespace {

void throwIfNothingCame(const std::string& name, const RunResult& run) {
  if (run.frames.empty()) {
    throw std::runtime_error(name +
                             ": no image has odometry at its stamp; the stamps of images and "
                             "odometry do not overlap, or the "
                             "odometry's gaps are longer than half a second");
  }
  const auto isEmpty = [](const RunFrame& frame) { return frame.result.features == 0; };
  if (std::all_of(run.frames.begin(), run.frames.end(), isEmpty)) {
    throw std::runtime_error(
        name +
        ": no image shows a corner: black, blank or blurred images, or threshold_min too high");
  }
}

/// A template, as observed and true poses are kept differently.
template <class Frames, class PoseOf>
bool neverMoves(const Frames& frames, const PoseOf& poseOf) {
  return frames.size() > 1 && std::all_of(frames.begin(), frames.end(), [&](const auto& frame) {
           const Eigen::Isometry3d& first = poseOf(frames.front());
           return (poseOf(frame).translation() - first.translation()).norm() <
                  StandstillWatch::kRest_m;
         });
}

/// Images that travel although the positions beside them are constant: zeros instead of poses.
std::string standstillFault(const std::string& name, const RunResult& run,
                            const Trajectory& truth) {
  if (!run.images_travel) return {};
  const auto observed = [](const RunFrame& f) -> const auto& {
    return f.result.T_odom_base;
  };
  const auto known = [](const StampedPose& p) -> const auto& {
    return p.T_frame_body;
  };
  const std::string end = " although the images do; ";
  if (neverMoves(truth.poses(), known)) {
    return name + ": the truth never moves" + end +
           "check the truth's topic or file (poses.txt, poses_tum.txt), or remove it";
  }
  if (neverMoves(run.frames, observed)) {
    return name + ": the odometry never moves" + end +
           "no landmark can be made: check what publishes it, or corrupt the truth by "
           "--odometry-profile";
  }
  return {};
}

std::vector<std::string> faultsOf(const std::string& name, const RunResult& run,
                                  const RunEvaluation& evaluation) {
  std::vector<std::string> faults;
  const std::string standstill = standstillFault(name, run, evaluation.truth);
  if (!standstill.empty()) faults.push_back(standstill);
  if (!run.is_in_loaded_map && !run.frames.empty() &&
      run.frames.back().result.state == SlamState::kSearchingMap)
    faults.push_back(name +
                     ": the odometry began anew, and its place was not found in the map again");
  if (run.is_in_loaded_map && evaluation.found_frame == run.frames.size()) {
    faults.push_back(name + ": the flight was not found in the loaded map, and no map is saved: " +
                     explain(SlamState::kSearchingMap));
  }
  const auto left_out = static_cast<std::size_t>(run.frames_without_odometry);
  const std::size_t all = left_out + run.frames.size();
  if (static_cast<double>(left_out) > kMuchLost * static_cast<double>(all)) {
    faults.push_back(name + ": " + std::to_string(left_out) + " of " + std::to_string(all) +
                     " images have no usable odometry at their stamp; record the odometry for as "
                     "long as the images, or choose the frames that have it by --frames");
  }
  if (evaluation.frames_error_not_finite > 0) {
    faults.push_back(name + ": the position error of " +
                     std::to_string(evaluation.frames_error_not_finite) + " of " +
                     std::to_string(run.frames.size()) +
                     " images is not finite, and the means leave them out; check the odometry's "
                     "and the truth's positions and the camera's mounting");
  }
  const auto landmarks = std::count_if(run.landmarks.begin(), run.landmarks.end(), isNotFinite);
  if (landmarks > 0) {
    faults.push_back(name + ": " + std::to_string(landmarks) + " of " +
                     std::to_string(run.landmarks.size()) +
                     " landmarks are not finite and are left out of landmarks.csv; check the "
                     "odometry's positions, the calibration and the camera's mounting");
  }
  return faults;
}

constexpr std::int64_t kTellingTracks = 1000;
constexpr double kRejected = 0.5;    // of the tracks; a good run rejects a tenth
constexpr int kSeen = 8;             // landmarks in an image; a wrong mounting leaves 2
constexpr double kDistrusted = 0.2;  // of the images

/// Share of the tracks that do not move as odometry, mounting and calibration foretell; 0 for too
/// few of them, and where landmarks are seen again all the same (odometry that drifts much).
double rejectedTracks(const RunResult& run) {
  std::int64_t tracks = 0, used = 0;
  const auto sees = std::count_if(run.frames.begin(), run.frames.end(), [](const RunFrame& frame) {
    return frame.result.landmark_matches >= kSeen;
  });
  if (2 * sees >= static_cast<std::ptrdiff_t>(run.frames.size())) return 0;
  for (const RunFrame& frame : run.frames) {
    tracks += frame.result.feature_candidates;
    used += frame.result.feature_matches;
  }
  if (tracks < kTellingTracks) return 0;
  return 1 - static_cast<double>(used) / static_cast<double>(tracks);
}

/// Whether the recording rather than the flight is to blame.
bool isDoctorsCase(const RunResult& run, double rejected) {
  const auto distrusted = static_cast<double>(countDistrusted(run));
  return rejected > kRejected || run.odometry_froze || run.absurd_speed_m_s > 0 ||
         distrusted > kDistrusted * static_cast<double>(run.frames.size());
}

bool isBag(const std::string& name) {
  return std::filesystem::path(name).extension() == ".bag";
}

double largestWay_m(const RunResult& run, double FrameResult::*way_m) {
  double largest_m = 0;
  for (const RunFrame& frame : run.frames) largest_m = std::max(largest_m, frame.result.*way_m);
  return largest_m;
}

/// By more than may be wrong of what a minute teaches.
bool isOtherThanConfigured(double factor) {
  constexpr double kMostFactor = 1.5;
  return factor > 0 && (factor > kMostFactor || 1 / factor > kMostFactor);
}

/// What was learned of the odometry's noise and is not as configured, a sentence each.
std::vector<std::string> tellLearnedNoise(const RunResult& run) {
  constexpr double kLearned_s = 60;
  if (run.frames.empty() || countDistrusted(run) > 0) return {};
  const FrameResult& first = run.frames.front().result;
  const FrameResult& last = run.frames.back().result;
  if (static_cast<double>(last.stamp_ns - first.stamp_ns) * 1e-9 < kLearned_s) return {};
  std::vector<std::string> sentences;
  char text[240];
  const double configured_m_s = first.velocity_bias_sigma_m_s;
  const double learned_m_s = last.velocity_bias_sigma_m_s;
  if (isOtherThanConfigured(learned_m_s / configured_m_s)) {
    std::snprintf(text, sizeof text,
                  "the odometry's velocity errs by %.2g m/s where %.2g was configured; with "
                  "velocity_bias_m_s: %.2g the covariance counts with it from the first image on",
                  learned_m_s, configured_m_s, learned_m_s);
    sentences.emplace_back(text);
  }
  if (isOtherThanConfigured(last.yaw_walk_factor)) {
    std::snprintf(text, sizeof text,
                  "the odometry's yaw drifts %.2g times as fast as configured; with "
                  "yaw_walk_deg_per_sqrt_s and yaw_walk_deg_per_sqrt_m times %.2g the covariance "
                  "counts with it from the first image on",
                  last.yaw_walk_factor, last.yaw_walk_factor);
    sentences.emplace_back(text);
  }
  return sentences;
}

void warnOfOdometry(const std::string& name, const RunResult& run, RunVerdict& verdict) {
  std::vector<std::string>& warnings = verdict.warnings;
  if (run.frames_without_odometry > 0) {
    warnings.push_back(std::to_string(run.frames_without_odometry) +
                       " images have no odometry at their stamp and are left out");
  }
  if (run.absurd_speed_m_s > 0)
    warnings.push_back(name + ": " + explainSpeed("the odometry", run.absurd_speed_m_s));
  const std::string offset_advice =
      adviceOn(run.time_offset, run.image_time_offset_told_s, run.image_time_offset_s);
  if (!offset_advice.empty()) warnings.push_back(name + ": " + offset_advice);
  if (verdict.faults.empty())
    for (const std::string& sentence : tellLearnedNoise(run))
      warnings.push_back(name + ": " + sentence);
  if (run.odometry_froze && verdict.faults.empty()) {
    warnings.push_back(name +
                       ": the odometry stood still for seconds while the images moved on; check "
                       "what publishes it");
  }
  const double step_m = largestWay_m(run, &FrameResult::odometry_step_m);
  if (step_m > 0) warnings.push_back(name + ": " + explainStep("the odometry", step_m));
  const double revisit_m = largestWay_m(run, &FrameResult::revisit_m);
  if (revisit_m > 0) warnings.push_back(name + ": " + explainRevisit(revisit_m));
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i) {
    const auto fault = static_cast<OdometryFault>(i);
    if (run.odometry_faults[i] == 0 || !isWorthWarning(fault)) continue;
    warnings.push_back(name + ": the odometry " + explain(fault) + " (" + nameOf(fault) + ": " +
                       std::to_string(run.odometry_faults[i]) + ")");
  }
}

void warnOfCamera(const std::string& name, const RunResult& run,
                  std::vector<std::string>& warnings) {
  const auto distrusted = countDistrusted(run);
  if (distrusted > 0) {
    const std::string fault = explain(run.setup, "BASE", "CAMERA");
    warnings.push_back(name + ": distrusted at " + std::to_string(distrusted) +
                       " images: " + (fault.empty() ? explain(SlamState::kDistrusted) : fault));
  }
  if (run.landmarks.empty()) {
    warnings.push_back(
        "no landmark came out, so the poses are the odometry's: images too dark, blurred or plain, "
        "no motion past what is seen (turning gives no depth), odometry that does not move with "
        "the images, "
        "or another camera's calibration");
  }
  const double rejected = rejectedTracks(run);
  if (rejected > kRejected) {
    warnings.push_back(
        name + ": " + std::to_string(std::lround(100 * rejected)) +
        " % of the tracks do not move as odometry, calibration and the camera's mounting foretell");
  }
  if (isBag(name) && isDoctorsCase(run, rejected)) {
    warnings.push_back("what is wrong with the recording tells: rosrun ardrone_vslam doctor " +
                       name);
  }
}

}  // namespace

RunVerdict judgeRun(const std::string& name, const RunResult& run, const RunEvaluation& evaluation,
                    bool truth_moved) {
  throwIfNothingCame(name, run);
  RunVerdict verdict;
  verdict.faults = faultsOf(name, run, evaluation);
  warnOfOdometry(name, run, verdict);
  warnOfCamera(name, run, verdict.warnings);
  if (truth_moved) {
    verdict.warnings.push_back(
        "truth and odometry start at different poses; the truth was moved as a whole to the "
        "odometry's start");
  }
  if (evaluation.frames_without_truth > 0) {
    verdict.warnings.push_back(std::to_string(evaluation.frames_without_truth) +
                               " images have no truth at their stamp and are not evaluated");
  }
  return verdict;
}

}  // namespace ardrone_vslam
