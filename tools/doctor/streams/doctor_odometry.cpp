// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

#include "ardrone_vslam/msckf_config.hpp"
#include "doctor/streams/adapted_odometry.hpp"
#include "input_checks/checked.hpp"
#include "input_checks/speed_watch.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kJump_m = 0.5;       // between two messages,
constexpr double kJump_m_s = 100;     // faster than any drone or car
constexpr double kRotated_rad = 0.1;  // by then a turn rate is not zero
constexpr double kWindow_s = 1;       // noise of the twist averages out
constexpr double kTelling_m = 0.5;    // way by which hypotheses must differ to be told apart
constexpr double kAgrees = 0.3;       // of that way
constexpr double kDisagrees = 0.5;    // of the way flown

double secondsBetween(const OdometryState& a, const OdometryState& b) {
  return static_cast<double>(b.stamp_ns - a.stamp_ns) * 1e-9;
}

std::string metres(double value_m) {
  std::ostringstream stream;
  stream << std::setprecision(2) << value_m << " m";
  return stream.str();
}

std::vector<const OdometryState*> usableStates(const DoctorRecording& recording) {
  std::vector<const OdometryState*> states;
  for (const DoctorOdometry& odometry : recording.odometry) {
    if (!odometry.state || odometry.state->stamp_ns <= 0) continue;
    states.push_back(&*odometry.state);
  }
  return states;
}

Eigen::Matrix3d mirroredYaw(const Eigen::Matrix3d& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  return Eigen::AngleAxisd(-2 * yaw, Eigen::Vector3d::UnitZ()) * R;
}

/// The way in x and y of a window, by the positions and by three readings of the twist.
struct Displacements {
  Eigen::Vector2d told_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d rotated_m = Eigen::Vector2d::Zero();    // by the orientation, as it should be
  Eigen::Vector2d mirrored_m = Eigen::Vector2d::Zero();   // with the yaw mirrored
  Eigen::Vector2d unrotated_m = Eigen::Vector2d::Zero();  // the twist is in odom's axes
};

std::vector<Displacements> displacementsOf(const std::vector<const OdometryState*>& states) {
  std::vector<Displacements> windows;
  Displacements window;
  double window_s = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const OdometryState &a = *states[i - 1], &b = *states[i];
    const double dt_s = secondsBetween(a, b);
    const Eigen::Vector3d told_m = b.T_odom_base.translation() - a.T_odom_base.translation();
    if (dt_s < 0 || dt_s > kWindow_s || told_m.norm() > kJump_m + kJump_m_s * dt_s) {
      window = {};
      window_s = 0;
      continue;
    }
    const Eigen::Vector3d displacement_m = dt_s * b.twist_base.head<3>();
    const Eigen::Matrix3d& R = b.T_odom_base.linear();
    window.told_m += told_m.head<2>();
    window.rotated_m += (R * displacement_m).head<2>();
    window.mirrored_m += (mirroredYaw(R) * displacement_m).head<2>();
    window.unrotated_m += displacement_m.head<2>();
    window_s += dt_s;
    if (window_s < kWindow_s) continue;
    windows.push_back(window);
    window = {};
    window_s = 0;
  }
  return windows;
}

/// Sum over the windows of how far two ways are apart.
template <class A, class B>
double apart_m(const std::vector<Displacements>& windows, A a, B b) {
  double sum_m = 0;
  for (const Displacements& displacements : windows)
    sum_m += (displacements.*a - displacements.*b).norm();
  return sum_m;
}

std::string listOf(const OdometryFaultCounts& counts, std::initializer_list<OdometryFault> faults) {
  std::string list;
  for (const OdometryFault fault : faults) {
    const auto count = counts[static_cast<std::size_t>(fault)];
    if (count == 0) continue;
    list += text(list.empty() ? "" : "; ", count, " times it ", explain(fault));
  }
  return list;
}

Finding checkJumps(const DoctorRecording& recording, const AdaptedOdometry& adapted) {
  Finding finding{"odometry_jumps", Verdict::kOk, "the position never jumps", {}};
  finding.text = listOf(adapted.faults, {OdometryFault::kJump, OdometryFault::kReset});
  std::size_t steps = 0;
  double longest_m = 0;
  const auto states = usableStates(recording);
  for (std::size_t i = 1; i < states.size(); ++i) {
    const double dt_s = secondsBetween(*states[i - 1], *states[i]);
    const double displacement_m =
        (states[i]->T_odom_base.translation() - states[i - 1]->T_odom_base.translation())
            .head<2>()  // heights have checks of their own
            .norm();
    if (dt_s < 0 || displacement_m <= kJump_m + kJump_m_s * dt_s) continue;
    ++steps;
    longest_m = std::max(longest_m, displacement_m);
  }
  if (finding.text.empty() && steps > 0) {
    finding.text = text(steps, " steps of up to ", metres(longest_m), " between two messages");
  }
  if (finding.text.empty()) {
    finding.text = "the position never jumps";
    return finding;
  }
  finding.verdict = Verdict::kWarning;
  finding.remedy =
      "odometry may drift but not jump: do not restart the driver in flight, do not write "
      "corrections back into it";
  return finding;
}

Finding checkUnit(const DoctorRecording& recording) {
  SpeedWatch watch;
  Eigen::AlignedBox3d positions;
  for (const OdometryState* state : usableStates(recording)) {
    watch.see(*state);
    positions.extend(state->T_odom_base.translation());
  }
  if (positions.isEmpty() || positions.diagonal().norm() < kTelling_m) {
    return {"odometry_unit", Verdict::kNotChecked, "because it hardly moves", {}};
  }
  if (watch.absurd_m_s() <= 0) {
    return {"odometry_unit", Verdict::kOk, "speeds are those of metres", {}};
  }
  return {"odometry_unit", Verdict::kFault, explainSpeed("the odometry", watch.absurd_m_s()),
          "divide its positions by 1000"};
}

}  // namespace

Findings checkOdometryValues(const DoctorRecording& recording) {
  if (recording.odometry.empty()) return {};
  const AdaptedOdometry adapted = adapt(recording, OdometryMode::kPose);
  Finding values{"odometry_values", Verdict::kOk, "all finite and within bounds", {}};
  if (adapted.states.empty()) {
    values.verdict = Verdict::kFault;
  } else if (adapted.refused > 1) {  // one is that with which a jump begins
    values.verdict = Verdict::kWarning;
  }
  if (values.verdict != Verdict::kOk) {
    values.text = text(adapted.refused, " of ", recording.odometry.size(),
                       " messages are not finite, out of bounds or no rotation");
    values.remedy = "correct their source: see docs/conventions.md for the bounds";
  }
  return {values, checkJumps(recording, adapted), checkUnit(recording)};
}

Findings checkOdometryFields(const DoctorRecording& recording,
                             std::vector<SuggestedParameter>& parameters) {
  const auto states = usableStates(recording);
  if (states.empty()) return {};
  Finding covariance{"odometry_covariance", Verdict::kOk, "given", {}};
  Finding angular_rate{"odometry_turn_rate", Verdict::kOk, "given", {}};
  const bool has_none = std::all_of(states.begin(), states.end(), [](const OdometryState* state) {
    return state->covariance.diagonal().head<3>().isZero(0);
  });
  std::string fault;
  for (const OdometryState* state : states) {
    if (fault.empty()) fault = covarianceFault(*state);
  }
  if (has_none || !fault.empty()) {
    covariance.verdict = Verdict::kWarning;
    covariance.text = has_none ? "all zero" : fault;
    const OdometryNoiseConfig noise;
    covariance.remedy =
        text("set walk_m_per_sqrt_m and walk_m_per_sqrt_s to how well it is known; the defaults, ",
             noise.walk_m_per_sqrt_m, " and ", noise.walk_m_per_sqrt_s, ", are a drone's");
    // Whatever a configuration says, it is the noise.
    constexpr double kAny = std::numeric_limits<double>::infinity();
    covariance.answered_by = {
        {"mapper", "walk_m_per_sqrt_m", text(noise.walk_m_per_sqrt_m),
         "the odometry gives no covariance; a drone's", kAny},
        {"mapper", "walk_m_per_sqrt_s", text(noise.walk_m_per_sqrt_s), "so, too", kAny}};
    parameters.insert(parameters.end(), covariance.answered_by.begin(),
                      covariance.answered_by.end());
  }
  double rotation_rad = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const Eigen::Quaterniond a(states[i - 1]->T_odom_base.linear());
    rotation_rad = std::max(rotation_rad,
                            Eigen::Quaterniond(states[0]->T_odom_base.linear()).angularDistance(a));
  }
  const bool has_rate = std::any_of(states.begin(), states.end(), [](const OdometryState* state) {
    return !state->twist_base.tail<3>().isZero(0);
  });
  if (!has_rate && rotation_rad > kRotated_rad) {
    angular_rate.verdict = Verdict::kWarning;
    angular_rate.text = "twist.angular is zero although the orientation turns";
    angular_rate.remedy = "nothing here needs it; a controller that does must take another source";
  } else if (!has_rate) {
    angular_rate = {"odometry_turn_rate", Verdict::kNotChecked, "because it does not turn", {}};
  }
  return {covariance, angular_rate};
}

Finding checkOdometryYaw(const DoctorRecording& recording,
                         std::vector<SuggestedParameter>& parameters) {
  Finding finding{"odometry_yaw", Verdict::kOk, {}, {}};
  const auto states = usableStates(recording);
  if (states.empty()) return {"odometry_yaw", Verdict::kNotChecked, "needs odometry", {}};
  const bool has_twist = std::any_of(states.begin(), states.end(), [](const OdometryState* state) {
    return !state->twist_base.head<3>().isZero(0);
  });
  if (!has_twist) {
    parameters.push_back({"mapper", "odometry_mode", "pose", "there is no twist"});
    return {"odometry_yaw", Verdict::kNotChecked, "because there is no twist", {}};
  }
  const std::vector<Displacements> windows = displacementsOf(states);
  double flown_m = 0;
  for (const Displacements& displacements : windows) flown_m += displacements.rotated_m.norm();
  const double wrong_m = apart_m(windows, &Displacements::told_m, &Displacements::rotated_m);
  const double telling_m = apart_m(windows, &Displacements::rotated_m, &Displacements::mirrored_m);
  const double mirrored_m = apart_m(windows, &Displacements::told_m, &Displacements::mirrored_m);
  const double unrotated_m = apart_m(windows, &Displacements::told_m, &Displacements::unrotated_m);
  if (flown_m < kTelling_m) {
    return {"odometry_yaw",
            Verdict::kNotChecked,
            "because it moves by " + metres(flown_m) + " only",
            {}};
  }
  if (telling_m > kTelling_m && mirrored_m < kAgrees * telling_m && mirrored_m < wrong_m) {
    finding.verdict = Verdict::kWarning;
    finding.text = text(
        "x and y are integrated with the yaw mirrored (ardrone_autonomy does): off "
        "by ",
        metres(wrong_m), " in ", metres(flown_m), " of way");
    finding.remedy = "set odometry_mode to twist";
    parameters.push_back({"mapper", "odometry_mode", "twist", "the pose's yaw is mirrored"});
    finding.answered_by = {parameters.back()};
  } else if (wrong_m > kDisagrees * flown_m) {
    finding.verdict = Verdict::kWarning;
    finding.text = text("pose and twist disagree: ", metres(wrong_m), " apart in ", metres(flown_m),
                        " of way");
    if (unrotated_m < kAgrees * wrong_m) finding.text += ", as the twist is in the axes of odom";
    finding.remedy = "keep odometry_mode at pose; the twist must be in axes of base";
    parameters.push_back({"mapper", "odometry_mode", "pose", "the twist is not the pose's"});
    finding.answered_by = {parameters.back()};
  } else if (telling_m < kTelling_m) {
    return {"odometry_yaw",
            Verdict::kNotChecked,
            "because it moves too little off the heading it began with: turn and fly on",
            {}};
  } else {
    finding.text = "the positions are the twist's integral, " + metres(wrong_m) + " apart in " +
                   metres(flown_m);
  }
  return finding;
}

}  // namespace ardrone_vslam
