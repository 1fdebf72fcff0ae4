// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_height.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>

#include "ardrone_vslam/odometry_faults.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kMost = 0.99;         // of the heights
constexpr double kClimb_m = 0.3;       // by which a height in metres must have changed
constexpr double kSmoothing_s = 0.6;   // a sonar's smoothing
constexpr double kStep_m = 0.25;       // that the velocity does not know
constexpr std::size_t kDistinct = 10;  // heights, before their unit tells anything
constexpr double kMillimetre = 1e-6;   // of one, for rounding
constexpr double kLongestGap_s = 1;    // that is integrated across

struct HeightSample {
  double t_s = 0;
  double z_m = 0;
  double climbed_m = 0;              // by the vertical velocity, since the beginning
  std::optional<double> altitude_m;  // the drone's own, of the same stamp
};

/// The drone's own height of this stamp. In bursts several of each have one stamp: the driver sends
/// them in turn. @param navdata  goes on to what comes behind it
std::optional<double> takeAltitude_m(const DoctorRecording& recording, std::int64_t stamp_ns,
                                     std::size_t& navdata) {
  const auto& all = recording.navdata;
  while (navdata < all.size() && all[navdata].time.stamp_ns < stamp_ns) ++navdata;
  if (navdata == all.size() || all[navdata].time.stamp_ns != stamp_ns) return std::nullopt;
  const auto& reading = all[navdata++].reading;
  return reading ? std::optional<double>(reading->measured.height_m) : std::nullopt;
}

std::vector<HeightSample> samplesOf(const DoctorRecording& recording) {
  std::vector<HeightSample> samples;
  const OdometryState* before = nullptr;
  std::size_t navdata = 0;
  for (const DoctorOdometry& odometry : recording.odometry) {
    if (!odometry.state || odometry.state->stamp_ns <= 0) continue;
    const OdometryState& state = *odometry.state;
    if (before && state.stamp_ns < before->stamp_ns) continue;
    HeightSample sample;
    sample.z_m = state.T_odom_base.translation().z();
    if (before) {
      const double dt_s = static_cast<double>(state.stamp_ns - before->stamp_ns) * 1e-9;
      const double climb_m_s = (state.T_odom_base.linear() * state.twist_base.head<3>()).z();
      sample.t_s = samples.back().t_s + dt_s;
      sample.climbed_m = samples.back().climbed_m + (dt_s < kLongestGap_s ? climb_m_s * dt_s : 0);
    }
    sample.altitude_m = takeAltitude_m(recording, state.stamp_ns, navdata);
    samples.push_back(sample);
    before = &state;
  }
  return samples;
}

template <class Is>
double share(const std::vector<HeightSample>& samples, Is is) {
  return static_cast<double>(std::count_if(samples.begin(), samples.end(), is)) /
         static_cast<double>(samples.size());
}

/// Changes of a height within a short time that the velocity does not know.
struct Steps {
  std::size_t count = 0;
  double largest_m = 0;
};

template <class Height>
Steps stepsOf(const std::vector<HeightSample>& samples, Height height) {
  Steps steps;
  const auto unknown_m = [&](std::size_t from, std::size_t to) {
    return std::abs(height(samples[to]) - height(samples[from]) -
                    (samples[to].climbed_m - samples[from].climbed_m));
  };
  std::size_t first = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    while (samples[i].t_s - samples[first].t_s > kSmoothing_s) ++first;
    if (unknown_m(first, i) < kStep_m) continue;
    // To its end, so that each counts once.
    std::size_t last = i;
    for (; i < samples.size() && samples[i].t_s - samples[last].t_s < kSmoothing_s; ++i) {
      if (unknown_m(first, i) > unknown_m(first, last)) last = i;
    }
    ++steps.count;
    steps.largest_m = std::max(steps.largest_m, unknown_m(first, last));
    first = i = last;
  }
  return steps;
}

std::string centimetres(double value_m) {
  return text(std::round(100 * value_m), " cm");
}

bool isWhole(const std::vector<HeightSample>& samples) {
  if (share(samples, [](const auto& s) { return s.z_m == std::round(s.z_m); }) < kMost) {
    return false;
  }
  const auto [lowest, highest] = std::minmax_element(
      samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.z_m < b.z_m; });
  const auto [least, most] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const auto& a, const auto& b) { return a.climbed_m < b.climbed_m; });
  // A vehicle on the ground has z = 0 all the time.
  return lowest->z_m != highest->z_m ||
         (lowest->z_m != 0 && most->climbed_m - least->climbed_m > kClimb_m);
}

/// Whether the heights come in millimetres, as the driver's integers do.
bool isInMillimetres(const std::vector<HeightSample>& samples) {
  std::set<double> distinct;
  for (const HeightSample& sample : samples) {
    const double z_mm = sample.z_m * 1000;
    if (std::abs(z_mm - std::round(z_mm)) > kMillimetre) return false;
    distinct.insert(std::round(z_mm));
  }
  return distinct.size() >= kDistinct;
}

Finding checkGround(const std::vector<HeightSample>& samples, bool whole) {
  Finding finding{"height_ground", Verdict::kOk, {}, {}};
  const auto height = [whole](const HeightSample& s) { return whole ? *s.altitude_m : s.z_m; };
  const bool has_altitudes = share(samples, [](const auto& s) { return s.altitude_m; }) == 1;
  if (whole && !has_altitudes) {
    return {"height_ground", Verdict::kNotChecked, "because heights come in whole metres", {}};
  }
  const Steps steps = stepsOf(samples, height);
  const bool is_altitude = has_altitudes && share(samples, [whole](const auto& s) {
                                              const double told_m =
                                                  whole ? std::trunc(*s.altitude_m) : *s.altitude_m;
                                              return std::abs(told_m - s.z_m) < 1e-9;
                                            }) >= kMost;
  if (whole && (!is_altitude || steps.count == 0)) {
    return {"height_ground", Verdict::kNotChecked, "because heights come in whole metres", {}};
  }
  if (is_altitude || isInMillimetres(samples)) {
    finding.text = "z is the height above what is below, as the drone fuses it";
  } else if (steps.count > 0) {
    finding.text = "z steps where the vertical velocity does not";
  } else {
    finding.text = "z follows the vertical velocity";
    return finding;
  }
  finding.verdict = Verdict::kWarning;
  finding.text += steps.count > 0 ? text(": ", steps.count, " steps of up to ",
                                         centimetres(steps.largest_m), ", by a table or the like")
                                  : ": it will step over a table (here it never does)";
  finding.remedy =
      "with odometry_mode twist set odometry_height to twist when you fly over furniture; z then "
      "drifts as x and y do";
  // It takes steps out that the velocity does not know (HeightJumpDetector).
  finding.answered_by = {{"mapper", "odometry_mode", "twist", "z steps over furniture"}};
  return finding;
}

}  // namespace

Findings checkHeight(const DoctorRecording& recording,
                     std::vector<SuggestedParameter>& parameters) {
  const std::vector<HeightSample> samples = samplesOf(recording);
  const auto notChecked = [](const std::string& why) -> Findings {
    return {{"height_metres", Verdict::kNotChecked, why, {}},
            {"height_ground", Verdict::kNotChecked, why, {}}};
  };
  if (samples.size() < kDistinct) return notChecked("needs odometry");
  const bool whole = isWhole(samples);
  Finding metres{"height_metres", Verdict::kOk, "z is finer than metres", {}};
  if (whole) {
    metres.verdict = Verdict::kWarning;
    metres.text = "z comes in whole metres (ardrone_autonomy before 1.4.1)";
    metres.remedy = "update the driver; odometry_mode twist smooths the steps until then";
    parameters.push_back({"mapper", "odometry_mode", "twist", "heights are cut to metres"});
    metres.answered_by = {parameters.back()};
  } else if (share(samples, [](const auto& s) { return s.z_m == std::round(s.z_m); }) >= kMost) {
    return notChecked("because the height does not change");
  }
  const bool climbs =
      std::any_of(samples.begin(), samples.end(), [](const auto& s) { return s.climbed_m != 0; });
  if (!climbs) {
    parameters.push_back({"mapper", "odometry_height", "pose", "there is no vertical velocity"});
    return {metres,
            {"height_ground", Verdict::kNotChecked, "because there is no vertical velocity", {}}};
  }
  const Finding ground = checkGround(samples, whole);
  if (ground.verdict == Verdict::kWarning && ground.text.find("steps of") != std::string::npos) {
    parameters.push_back({"mapper", "odometry_mode", "twist", "z steps over furniture"});
    parameters.push_back({"mapper", "odometry_height", "twist", "so, too"});
  }
  return {metres, ground};
}

}  // namespace ardrone_vslam
