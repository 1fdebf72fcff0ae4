// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone/navdata_sync.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kRestart_ns = 1'000'000'000;   // stamps further back are a new run
constexpr std::int64_t kLongestGap_ns = 100'000'000;  // that packets are spread over
constexpr std::int64_t kImuKept_ns = 1'000'000'000;

}  // namespace

NavdataSync::Added NavdataSync::add(const NavdataReading& packet) {
  Added added = Added::kYes;
  if (newest_packet_ns_ != 0 && packet.stamp_ns <= newest_packet_ns_ - kRestart_ns) {
    added = Added::kRestart;
    packets_.clear();
    last_group_ns_ = 0;
    // Unless the IMU's new run was there first.
    if (newest_imu_ns_ > newest_packet_ns_ - kRestart_ns) {
      imu_.clear();
      newest_imu_ns_ = 0;
    }
  } else if (packet.stamp_ns < newest_packet_ns_) {
    return Added::kBackward;
  }
  newest_packet_ns_ = packet.stamp_ns;
  packets_.push_back(packet);
  return added;
}

bool NavdataSync::add(const DroneImu& imu) {
  if (newest_imu_ns_ != 0 && imu.stamp_ns <= newest_imu_ns_ - kRestart_ns) {
    imu_.clear();
  } else if (imu.stamp_ns < newest_imu_ns_) {
    return false;
  }
  newest_imu_ns_ = imu.stamp_ns;
  imu_.push_back(imu);
  while (imu.stamp_ns - imu_.front().stamp_ns > kImuKept_ns) imu_.pop_front();
  return true;
}

bool NavdataSync::isFirstReady() const {
  if (packets_.empty()) return false;
  const std::int64_t first_ns = packets_.front().stamp_ns;
  const bool has_imu =
      newest_imu_ns_ > first_ns || newest_packet_ns_ - first_ns >= DroneObserver::kLongestWait_ns;
  return newest_packet_ns_ > first_ns && has_imu;
}

std::vector<NavdataSample> NavdataSync::takeFirst() {
  const std::int64_t stamp_ns = packets_.front().stamp_ns;
  std::vector<NavdataSample> samples;
  for (; !packets_.empty() && packets_.front().stamp_ns == stamp_ns; packets_.pop_front())
    samples.push_back({packets_.front(), std::nullopt});
  putImuInto(samples);
  const std::int64_t gap_ns =
      last_group_ns_ == 0 ? 0 : std::min(stamp_ns - last_group_ns_, kLongestGap_ns);
  last_group_ns_ = stamp_ns;
  const auto count = static_cast<std::int64_t>(samples.size());
  for (std::int64_t i = 0; i < count; ++i) {
    samples[static_cast<std::size_t>(i)].packet.stamp_ns =
        stamp_ns - gap_ns * (count - 1 - i) / count;
  }
  return samples;
}

/// The readings up to the packets' stamp: one each, or else their mean into all.
void NavdataSync::putImuInto(std::vector<NavdataSample>& samples) {
  std::vector<DroneImu> readings;
  for (; !imu_.empty() && imu_.front().stamp_ns <= samples.front().packet.stamp_ns;
       imu_.pop_front()) {
    if (imu_.front().stamp_ns > last_group_ns_) readings.push_back(imu_.front());
  }
  if (readings.empty()) return;
  if (readings.size() != samples.size()) {
    DroneImu mean = readings.front();
    const auto share = 1 / static_cast<double>(readings.size());
    mean.angular_rate_base_rad_s.setZero();
    mean.force_base_m_s2.setZero();
    for (const DroneImu& reading : readings) {
      mean.angular_rate_base_rad_s += share * reading.angular_rate_base_rad_s;
      mean.force_base_m_s2 += share * reading.force_base_m_s2;
    }
    readings.assign(samples.size(), mean);
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].packet.measured.force_base_m_s2 = readings[i].force_base_m_s2;
    samples[i].angular_rate_base_rad_s = readings[i].angular_rate_base_rad_s;
  }
}

}  // namespace ardrone_vslam
