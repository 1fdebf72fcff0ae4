// SPDX-License-Identifier: BSD-3-Clause
#include "summary/run_words.hpp"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kBetter = 0.9;  // fused over odometry; within a tenth is no difference
constexpr double kWorse = 1.1;
// NEES / 3 of an honest covariance; a flight's errors are of one piece, so its mean spreads widely.
constexpr double kModest = 0.3;
constexpr double kOverconfident = 1.5;
constexpr double kMuch = 0.2;   // of the images
constexpr double kGood = 0.01;  // of the distance travelled: better than most odometry

bool isKnown(const Json& summary, const char* key) {
  return summary.contains(key) && summary[key].is_number();
}

double valueOf(const Json& summary, const char* key) {
  return isKnown(summary, key) ? summary[key].get<double>() : 0;
}

std::string rounded(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/// To the centimetre, below 0.1 m to the millimetre.
std::string metres(double value) {
  return rounded(value, std::abs(value) < 0.1 ? 3 : 2) + " m";
}

double imagesIn(const Json& summary, const char* state) {
  return summary.contains("states") ? valueOf(summary["states"], state) : 0;
}

/// Why the images brought nothing, and what would; the first that holds.
std::string reasonFor(const Json& summary) {
  const double frames = valueOf(summary, "frames");
  if (valueOf(summary, "frames_distrusted") > kMuch * frames)
    return "The camera was not believed in " + rounded(valueOf(summary, "frames_distrusted"), 0) +
           " of the images: see the warning.";
  if (summary.value("estimator", "") == "odometry")
    return "With estimator: odometry the images are only looked at.";
  if (valueOf(summary, "landmarks") == 0)
    return "No landmark came out: the camera must move past what it sees, as turning shows no "
           "depth.";
  if (valueOf(summary, "odometry_ate_rmse_m") < kGood * valueOf(summary, "distance_m"))
    return "This odometry errs by " +
           rounded(100 * valueOf(summary, "odometry_ate_rmse_m") / valueOf(summary, "distance_m"),
                   2) +
           " % of the distance travelled, which leaves little to gain.";
  if (valueOf(summary, "heights_used") == 0 && isKnown(summary, "ratio_scale_removed") &&
      valueOf(summary, "ratio_scale_removed") < kBetter * valueOf(summary, "ratio"))
    return "What is left is mostly the odometry's scale, which one camera cannot tell; heights "
           "above the floor can (use_range).";
  if (imagesIn(summary, "localised") + imagesIn(summary, "relocated") < kMuch * frames)
    return "Little was seen again after it had left the image: come back to where the flight has "
           "been.";
  return "Why, the report (--report) and doctor may tell.";
}

std::string covarianceLine(const Json& summary) {
  if (!isKnown(summary, "nees_mean")) return "not judged: no ground truth";
  const double nees = valueOf(summary, "nees_mean") / 3;
  const char* const word = nees > kOverconfident ? "too small"
                           : nees < kModest      ? "larger than the errors"
                                                 : "honest";
  return std::string(word) + ": squared errors are " + rounded(nees, 2) +
         " times the expected ones, " + rounded(100 * valueOf(summary, "outside_3_sigma"), 1) +
         " % of the images beyond 3 sigma";
}

/// With a line's end before it; empty without a refinement.
std::string refinedLine(const Json& summary) {
  if (!summary.contains("refined_keyframes")) return "";
  const std::string errors = isKnown(summary, "refined_ate_rmse_m")
                                 ? "off by " + metres(valueOf(summary, "refined_ate_rmse_m")) +
                                       " (RMSE), at most by " +
                                       metres(valueOf(summary, "refined_error_max_m")) + "; "
                                 : "error not known; ";
  return "\nrefined     " + errors + rounded(valueOf(summary, "refined_points"), 0) +
         " points in " + rounded(valueOf(summary, "refined_keyframes"), 0) + " keyframes";
}

std::string statesLine(const Json& summary) {
  std::string text;
  for (const auto& state : summary["states"].items())
    text += (text.empty() ? "" : ", ") + state.key() + " " + state.value().dump();
  return text + " images; " + rounded(valueOf(summary, "landmarks"), 0) + " landmarks";
}

/// What was given and has no pose.
std::string lossesOf(const Json& summary) {
  std::string text;
  const auto add = [&](const char* key, const char* why) {
    if (valueOf(summary, key) > 0) text += "; " + rounded(valueOf(summary, key), 0) + why;
  };
  add("frames_dropped_slow", " dropped as too slow");
  add("frames_without_odometry", " left out without odometry");
  add("frames_searching_map", " before the map was found");
  return text;
}

}  // namespace

std::string verdictOf(const Json& summary) {
  if (!isKnown(summary, "fused_ate_rmse_m"))
    return "Without ground truth nobody knows how far odometry and fused pose are off.";
  const std::string fused = metres(valueOf(summary, "fused_ate_rmse_m"));
  if (!isKnown(summary, "ratio"))
    return "The odometry has no error, so there is nothing to gain; the fused pose is off by " +
           fused + ".";
  const std::string errors = "the odometry is off by " +
                             metres(valueOf(summary, "odometry_ate_rmse_m")) +
                             ", the fused pose by " + fused + " (RMSE).";
  const double ratio = valueOf(summary, "ratio");
  if (ratio <= kBetter) return "It helped: " + errors;
  return (ratio <= kWorse ? "It did not help: " : "It did harm: ") + errors + " " +
         reasonFor(summary);
}

std::string inLines(const Json& summary) {
  const bool is_known = isKnown(summary, "fused_ate_rmse_m");
  std::ostringstream text;
  text << "images      " << summary["frames"] << " in "
       << rounded(valueOf(summary, "duration_s"), 1) << " s, "
       << rounded(valueOf(summary, "distance_m"), 1) << " m travelled" << lossesOf(summary) << "\n"
       << "odometry    "
       << (is_known ? "off by " + metres(valueOf(summary, "odometry_ate_rmse_m")) + " (RMSE)"
                    : "error not known")
       << "\nfused       "
       << (is_known ? "off by " + metres(valueOf(summary, "fused_ate_rmse_m")) +
                          " (RMSE), at most by " + metres(valueOf(summary, "fused_error_max_m"))
                    : "error not known");
  if (isKnown(summary, "ratio"))
    text << "; " << rounded(valueOf(summary, "ratio"), 3) << " of the odometry's";
  text << refinedLine(summary) << "\ncovariance  " << covarianceLine(summary) << "\nstates      "
       << statesLine(summary) << "\ncost        "
       << rounded(valueOf(summary, "ms_per_frame_median"), 2) << " ms an image, below "
       << rounded(valueOf(summary, "ms_per_frame_p95"), 2) << " ms for 95 % of them\n";
  return text.str();
}

}  // namespace ardrone_vslam
