// SPDX-License-Identifier: BSD-3-Clause
#include "doctor_navdata.hpp"

#include <algorithm>
#include <cmath>

#include "../../nodes/checked.hpp"  // no ROS
#include "ardrone_vslam/rotation.hpp"
#include "doctor_stamps.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSlowestNavdata_hz = 10;  // navdata_demo: 15
constexpr double kSlowestImu_hz = 10;
constexpr double kGravity_m_s2 = 9.81;
constexpr double kOtherUnit = 1.5;     // by which the median force differs from gravity
constexpr double kLowest_m = 0.05;     // no flight stays below it
constexpr double kHighest_m = 100;     // the drone's own limit
constexpr double kSlowest_m_s = 0.01;  // optical flow is noisier than that
constexpr double kFastest_m_s = 20;
constexpr double kWindow_s = 1;
constexpr double kLongestStep_s = 0.1;  // that turn rates are integrated across
constexpr double kTelling_rad = 0.5;    // of turning, before rate and attitude are compared
constexpr double kDisagrees = 0.5;      // of that turning

using Push = ObserverBuffer::Push;

bool isRefused(Push answer) {
  return answer == Push::kNotFinite || answer == Push::kOutOfRange;
}

/// Usable readings in flight, or on the ground as well.
std::vector<const NavdataReading*> readingsOf(const DoctorRecording& recording, bool in_flight) {
  std::vector<const NavdataReading*> readings;
  for (const DoctorNavdata& navdata : recording.navdata) {
    if (!navdata.reading || (in_flight && navdata.reading->is_standing)) continue;
    readings.push_back(&*navdata.reading);
  }
  return readings;
}

std::vector<const DroneImu*> imuOf(const DoctorRecording& recording) {
  std::vector<const DroneImu*> readings;
  for (const DoctorImu& imu : recording.imu) {
    if (imu.reading) readings.push_back(&*imu.reading);
  }
  return readings;
}

/// "" for gravity and what a flight adds to it. @param forces_m_s2  their sizes
std::string forceFault(std::vector<double> forces_m_s2, double unit_m_s2, const char* unit) {
  forces_m_s2.erase(std::remove_if(forces_m_s2.begin(), forces_m_s2.end(),
                                   [](double force) { return !std::isfinite(force); }),
                    forces_m_s2.end());
  if (forces_m_s2.empty()) return {};
  const double median_m_s2 = medianOf(std::move(forces_m_s2));
  if (median_m_s2 > kGravity_m_s2 / kOtherUnit && median_m_s2 < kGravity_m_s2 * kOtherUnit) {
    return {};
  }
  return text("the accelerometer reads ", rounded(median_m_s2 / unit_m_s2, 2), " ", unit,
              " in the median, gravity is ", kGravity_m_s2 / unit_m_s2);
}

Finding checkValues(const DoctorRecording& recording, const AdaptedOdometry& observed) {
  Finding finding{"navdata_values", Verdict::kOk, "all finite and within bounds", {}};
  const auto readings = readingsOf(recording, false);
  std::vector<double> forces_m_s2;
  bool is_zero = true;
  for (const NavdataReading* reading : readings) {
    const DroneMeasurement& m = reading->measured;
    forces_m_s2.push_back(m.force_base_m_s2.norm());
    is_zero = is_zero && m.R_odom_base.isIdentity(0) && m.flow_base_m_s.isZero(0) &&
              m.force_base_m_s2.isZero(0) && m.height_m == 0;
  }
  const bool is_needed = isNavdataTheObserver(recording);
  const std::string force = forceFault(forces_m_s2, kGravity_m_s2, "g");
  if (is_zero) {
    finding.verdict = is_needed ? Verdict::kFault : Verdict::kWarning;
    finding.text = text("all ", readings.size(), " packets are zero");
    finding.remedy = "is the driver connected to a drone that is switched on?";
  } else if (observed.refused > 0) {
    const bool is_none = observed.refused == readings.size();
    finding.verdict = is_needed && is_none ? Verdict::kFault : Verdict::kWarning;
    finding.text =
        text(observed.refused, " of ", readings.size(), " packets are not finite or out of bounds");
    finding.remedy = "they are left out; check the driver and the link";
  } else if (!force.empty()) {
    finding.verdict = Verdict::kWarning;
    finding.text = force;
    finding.remedy =
        recording.imu.empty()
            ? "g are asked for in ax, ay, az; record /ardrone/imu, which is used then"
            : "g are asked for in ax, ay, az; the IMU's are used where it has a reading";
  }
  return finding;
}

Finding checkNavdataHeight(const std::vector<const NavdataReading*>& flying) {
  Finding finding{"navdata_height", Verdict::kOk, {}, {}};
  double highest_m = 0;
  for (const NavdataReading* reading : flying)
    highest_m = std::max(highest_m, reading->measured.height_m);
  finding.text = text("up to ", rounded(highest_m, 2), " m");
  if (highest_m <= 0) {
    finding.verdict = Verdict::kWarning;
    finding.text = "altd is never above zero in flight";
    finding.remedy = "check the ultrasound sensor below the drone: without it z drifts";
  } else if (highest_m < kLowest_m || highest_m > kHighest_m) {
    finding.verdict = Verdict::kWarning;
    finding.text = text("altd is at most ", std::lround(highest_m * 1000), " in flight, which is ",
                        highest_m, " m");
    finding.remedy = "millimetres are asked for: correct its source";
  }
  return finding;
}

Finding checkVelocity(const std::vector<const NavdataReading*>& flying) {
  Finding finding{"navdata_velocity", Verdict::kOk, {}, {}};
  double fastest_m_s = 0;
  for (const NavdataReading* reading : flying) {
    const double speed_m_s = reading->measured.flow_base_m_s.norm();
    if (speed_m_s > fastest_m_s) fastest_m_s = speed_m_s;  // not so for NaN
  }
  finding.text = text("up to ", rounded(fastest_m_s, 2), " m/s");
  if (fastest_m_s <= 0) {
    finding.verdict = Verdict::kWarning;
    finding.text = "vx and vy are zero throughout the flight";
    finding.remedy =
        "the drone measures them by its bottom camera: give it light, a floor with texture, and "
        "navdata_demo as the driver's launch file does";
  } else if (fastest_m_s < kSlowest_m_s || fastest_m_s > kFastest_m_s) {
    finding.verdict = Verdict::kWarning;
    finding.text = text("vx and vy are at most ", fastest_m_s * 1000, " in flight, which is ",
                        fastest_m_s, " m/s");
    finding.remedy = "mm/s are asked for: correct their source";
  }
  return finding;
}

Finding checkImuValues(const DoctorRecording& recording, const AdaptedOdometry& observed) {
  Finding finding{"imu_values", Verdict::kOk, "all finite and within bounds", {}};
  std::vector<double> forces_m_s2;
  bool is_zero = true;
  for (const DroneImu* imu : imuOf(recording)) {
    forces_m_s2.push_back(imu->force_base_m_s2.norm());
    is_zero = is_zero && imu->force_base_m_s2.isZero(0) && imu->turn_rate_base_rad_s.isZero(0);
  }
  const std::string force = forceFault(forces_m_s2, 1, "m/s^2");
  if (is_zero) {
    finding.text = text("all ", forces_m_s2.size(), " messages are zero");
    finding.remedy =
        "set the driver's navdata_demo to 0, with which the drone sends its raw measurements; or "
        "leave the IMU out";
  } else if (observed.refused_imu > 0) {
    finding.text = text(observed.refused_imu, " of ", forces_m_s2.size(),
                        " messages are not finite or out of bounds");
    finding.remedy = "they are left out; check the driver and the link";
  } else if (!force.empty()) {
    finding.text = force;
    finding.remedy = "m/s^2 are asked for: correct its source";
  } else {
    return finding;
  }
  finding.verdict = Verdict::kWarning;
  return finding;
}

/// Turns by the attitude and by the turn rates, summed over windows.
struct Turns {
  double told_rad = 0;
  double felt_rad = 0;
  double apart_rad = 0;
};

Turns turnsOf(const std::vector<const NavdataReading*>& navdata,
              const std::vector<const DroneImu*>& imu) {
  Turns turns;
  const NavdataReading* begin = nullptr;
  Eigen::Matrix3d felt = Eigen::Matrix3d::Identity();
  std::size_t next = 0;
  for (std::size_t i = 1; i < imu.size(); ++i) {
    const std::int64_t stamp_ns = imu[i]->stamp_ns;
    const double dt_s = static_cast<double>(stamp_ns - imu[i - 1]->stamp_ns) * 1e-9;
    if (dt_s == 0) continue;  // of a burst one stands for all
    while (next < navdata.size() && navdata[next]->stamp_ns < stamp_ns) ++next;
    if (next == navdata.size()) break;
    const Eigen::Vector3d& rate_rad_s = imu[i]->turn_rate_base_rad_s;
    const NavdataReading* here = navdata[next];
    const bool is_sound = dt_s > 0 && dt_s < kLongestStep_s && rate_rad_s.allFinite() &&
                          here->measured.R_odom_base.allFinite();
    if (!is_sound || !begin) {
      begin = is_sound ? here : nullptr;
      felt.setIdentity();
      continue;
    }
    felt = felt * rotationOf(dt_s * rate_rad_s);
    if (static_cast<double>(here->stamp_ns - begin->stamp_ns) * 1e-9 < kWindow_s) continue;
    const Eigen::Vector3d told_rad =
        rotationVectorOf(begin->measured.R_odom_base.transpose() * here->measured.R_odom_base);
    const Eigen::Vector3d felt_rad = rotationVectorOf(felt);
    turns.told_rad += told_rad.norm();
    turns.felt_rad += felt_rad.norm();
    turns.apart_rad += (told_rad - felt_rad).norm();
    begin = here;
    felt.setIdentity();
  }
  return turns;
}

Finding checkTurnRate(const DoctorRecording& recording) {
  const Turns turns = turnsOf(readingsOf(recording, false), imuOf(recording));
  const double turned_rad = std::max(turns.told_rad, turns.felt_rad);
  if (turned_rad < kTelling_rad) {
    return {"imu_turn_rate", Verdict::kNotChecked, "because it hardly turns", {}};
  }
  Finding finding{"imu_turn_rate", Verdict::kOk, {}, {}};
  finding.text = text("turn rates add up to ", rounded(turns.felt_rad, 1),
                      " rad, navdata's attitude turns by ", rounded(turns.told_rad, 1), ", ",
                      rounded(turns.apart_rad, 1), " apart");
  if (turns.apart_rad > kDisagrees * turned_rad) {
    finding.verdict = Verdict::kWarning;
    finding.remedy =
        "rad/s about base's axes (x forward, y left, z up) are asked for, in navdata degrees: "
        "correct the wrong one's source, or leave the IMU out";
  }
  return finding;
}

/// What is not needed does not keep the rest from working.
void append(Findings& findings, bool is_needed, Findings more) {
  for (Finding& finding : more) {
    if (!is_needed && finding.verdict == Verdict::kFault) finding.verdict = Verdict::kWarning;
    findings.push_back(std::move(finding));
  }
}

Findings checkStream(const StreamName& name, const std::string& topic,
                     const std::vector<DoctorTime>& times, double slowest_hz) {
  const StampStatistics s = statisticsOf(times);
  if (s.messages == 0) {
    return {{name.id + "_rate", Verdict::kFault, topic + " holds no message",
             "start the driver before recording"}};
  }
  return {checkRate(name, s, slowest_hz,
                    "set the driver's navdata_demo to 0, with which the drone sends 200 a second"),
          checkStamps(name, s, false), checkBursts(name, s)};
}

}  // namespace

AdaptedOdometry observeNavdata(const DoctorRecording& recording) {
  AdaptedOdometry observed;
  DroneObserver observer{DroneFilterConfig()};
  auto imu = recording.imu.begin();
  const auto takeImu = [&](std::int64_t until_ns) {
    for (; imu != recording.imu.end() && imu->time.received_ns <= until_ns; ++imu) {
      if (imu->reading && isRefused(observer.push(*imu->reading, observed.states)))
        ++observed.refused_imu;
    }
  };
  for (const DoctorNavdata& navdata : recording.navdata) {
    takeImu(navdata.time.received_ns);
    if (navdata.reading && isRefused(observer.push(*navdata.reading, observed.states)))
      ++observed.refused;
  }
  takeImu(recording.imu.empty() ? 0 : recording.imu.back().time.received_ns);
  observer.flush(observed.states);
  observed.faults = observer.faults();
  // Begun anew, they would go back.
  const auto rises = [last_ns = std::int64_t{0}](const ObserverState& state) mutable {
    const bool is_later = state.stamp_ns > last_ns;
    last_ns = std::max(last_ns, state.stamp_ns);
    return !is_later;
  };
  observed.states.erase(std::remove_if(observed.states.begin(), observed.states.end(), rises),
                        observed.states.end());
  return observed;
}

Findings checkNavdataStreams(const DoctorRecording& recording) {
  if (recording.navdata_topic.empty()) return {};
  const bool is_needed = isNavdataTheObserver(recording);
  Findings findings;
  append(findings, is_needed,
         checkStream({"navdata", "packets"}, recording.navdata_topic, timesOf(recording.navdata),
                     kSlowestNavdata_hz));
  if (!recording.imu_topic.empty()) {
    append(findings, false,
           checkStream({"imu", "messages"}, recording.imu_topic, timesOf(recording.imu),
                       kSlowestImu_hz));
  } else if (is_needed) {
    findings.push_back({"imu_rate", Verdict::kWarning, "there is no sensor_msgs/Imu",
                        "record /ardrone/imu as well; navdata's accelerations stand in for it"});
  }
  return findings;
}

Findings checkNavdataValues(const DoctorRecording& recording) {
  if (recording.navdata.empty()) return {};
  const AdaptedOdometry observed = observeNavdata(recording);
  Findings findings{checkValues(recording, observed)};
  const auto flying = readingsOf(recording, true);
  if (flying.empty()) {
    for (const char* check : {"navdata_height", "navdata_velocity"}) {
      findings.push_back(
          {check, Verdict::kNotChecked, "because it never flies, by navdata's state", {}});
    }
  } else {
    findings.push_back(checkNavdataHeight(flying));
    findings.push_back(checkVelocity(flying));
  }
  if (recording.imu.empty()) return findings;
  findings.push_back(checkImuValues(recording, observed));
  findings.push_back(checkTurnRate(recording));
  return findings;
}

}  // namespace ardrone_vslam
