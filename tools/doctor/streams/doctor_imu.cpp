// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_imu.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "doctor/recording/doctor_stamps.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kOtherUnit = 1.5;  // by which the median force differs from gravity
constexpr double kRotationWindow_s = 1;
constexpr double kLongestStep_s = 0.1;      // that turn rates are integrated across
constexpr double kTelling_rad = 0.5;        // of turning, before rate and attitude are compared
constexpr double kRotationDisagrees = 0.5;  // of that turning

std::vector<const DroneImu*> imuOf(const DoctorRecording& recording) {
  std::vector<const DroneImu*> readings;
  for (const DoctorImu& imu : recording.imu) {
    if (imu.reading) readings.push_back(&*imu.reading);
  }
  return readings;
}

std::vector<const NavdataReading*> navdataOf(const DoctorRecording& recording) {
  std::vector<const NavdataReading*> readings;
  for (const DoctorNavdata& navdata : recording.navdata) {
    if (navdata.reading) readings.push_back(&*navdata.reading);
  }
  return readings;
}

/// Rotations by the attitude and by the turn rates, summed over windows.
struct Rotations {
  double told_rad = 0;
  double felt_rad = 0;
  double apart_rad = 0;
};

void add(const NavdataReading& begin, const NavdataReading& end, const Eigen::Matrix3d& felt,
         Rotations& rotations) {
  const Eigen::Vector3d told_rad =
      rotationVectorOf(begin.measured.R_odom_base.transpose() * end.measured.R_odom_base);
  const Eigen::Vector3d felt_rad = rotationVectorOf(felt);
  rotations.told_rad += told_rad.norm();
  rotations.felt_rad += felt_rad.norm();
  rotations.apart_rad += (told_rad - felt_rad).norm();
}

bool isSound(double dt_s, const Eigen::Vector3d& rate_rad_s, const NavdataReading& navdata) {
  return dt_s > 0 && dt_s < kLongestStep_s && rate_rad_s.allFinite() &&
         navdata.measured.R_odom_base.allFinite();
}

/// Index of the first one at or after a stamp. @param begin  where to begin to look
std::size_t firstFrom(std::int64_t stamp_ns, const std::vector<const NavdataReading*>& navdata,
                      std::size_t begin) {
  while (begin < navdata.size() && navdata[begin]->stamp_ns < stamp_ns) ++begin;
  return begin;
}

Rotations rotationsOf(const std::vector<const NavdataReading*>& navdata,
                      const std::vector<const DroneImu*>& imu) {
  Rotations rotations;
  const NavdataReading* begin = nullptr;
  Eigen::Matrix3d felt = Eigen::Matrix3d::Identity();
  std::size_t next = 0;
  for (std::size_t i = 1; i < imu.size(); ++i) {
    const std::int64_t stamp_ns = imu[i]->stamp_ns;
    const double dt_s = static_cast<double>(stamp_ns - imu[i - 1]->stamp_ns) * 1e-9;
    if (dt_s == 0) continue;  // of a burst one stands for all
    next = firstFrom(stamp_ns, navdata, next);
    if (next == navdata.size()) break;
    const Eigen::Vector3d& rate_rad_s = imu[i]->angular_rate_base_rad_s;
    const NavdataReading* here = navdata[next];
    const bool is_sound = isSound(dt_s, rate_rad_s, *here);
    if (is_sound && begin) {
      felt = felt * rotationOf(dt_s * rate_rad_s);
      if (static_cast<double>(here->stamp_ns - begin->stamp_ns) * 1e-9 < kRotationWindow_s)
        continue;
      add(*begin, *here, felt, rotations);
    }
    begin = is_sound ? here : nullptr;
    felt.setIdentity();
  }
  return rotations;
}

}  // namespace

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

Finding checkImuValues(const DoctorRecording& recording, std::size_t refused) {
  Finding finding{"imu_values", Verdict::kOk, "all finite and within bounds", {}};
  std::vector<double> forces_m_s2;
  bool is_zero = true;
  for (const DroneImu* imu : imuOf(recording)) {
    forces_m_s2.push_back(imu->force_base_m_s2.norm());
    is_zero = is_zero && imu->force_base_m_s2.isZero(0) && imu->angular_rate_base_rad_s.isZero(0);
  }
  const std::string force = forceFault(forces_m_s2, 1, "m/s^2");
  if (is_zero) {
    finding.text = text("all ", forces_m_s2.size(), " messages are zero");
    finding.remedy =
        "set the driver's navdata_demo to 0, with which the drone sends its raw measurements; or "
        "leave the IMU out";
  } else if (refused > 0) {
    finding.text =
        text(refused, " of ", forces_m_s2.size(), " messages are not finite or out of bounds");
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

Finding checkImuTurnRate(const DoctorRecording& recording) {
  const Rotations rotations = rotationsOf(navdataOf(recording), imuOf(recording));
  const double rotation_rad = std::max(rotations.told_rad, rotations.felt_rad);
  if (rotation_rad < kTelling_rad) {
    return {"imu_turn_rate", Verdict::kNotChecked, "because it hardly turns", {}};
  }
  Finding finding{"imu_turn_rate", Verdict::kOk, {}, {}};
  finding.text = text("turn rates add up to ", rounded(rotations.felt_rad, 1),
                      " rad, navdata's attitude turns by ", rounded(rotations.told_rad, 1), ", ",
                      rounded(rotations.apart_rad, 1), " apart");
  if (rotations.apart_rad > kRotationDisagrees * rotation_rad) {
    finding.verdict = Verdict::kWarning;
    finding.remedy =
        "rad/s about base's axes (x forward, y left, z up) are asked for, in navdata degrees: "
        "correct the wrong one's source, or leave the IMU out";
  }
  return finding;
}

}  // namespace ardrone_vslam
