// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_navdata.hpp"

#include <algorithm>
#include <cmath>

#include "doctor/recording/doctor_stamps.hpp"
#include "doctor/streams/doctor_imu.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSlowestNavdata_hz = 10;  // navdata_demo: 15
constexpr double kSlowestImu_hz = 10;
constexpr double kLowest_m = 0.05;     // no flight stays below it
constexpr double kHighest_m = 100;     // the drone's own limit
constexpr double kSlowest_m_s = 0.01;  // optical flow is noisier than that
constexpr double kFastest_m_s = 20;

using Push = OdometryBuffer::Push;

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
  const bool is_needed = isNavdataTheOdometry(recording);
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
  DroneObserver observer;
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
  const auto rises = [last_ns = std::int64_t{0}](const OdometryState& state) mutable {
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
  const bool is_needed = isNavdataTheOdometry(recording);
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
  findings.push_back(checkImuValues(recording, observed.refused_imu));
  findings.push_back(checkImuTurnRate(recording));
  return findings;
}

}  // namespace ardrone_vslam
