// SPDX-License-Identifier: BSD-3-Clause
// What every stream of messages is looked at for, whatever it carries.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// How the stamps of a topic follow each other.
struct StampStatistics {
  std::size_t messages = 0;
  std::size_t without = 0;   ///< stamps of zero
  std::size_t backward = 0;  ///< less than a second before the newest
  std::size_t restarts = 0;  ///< further before it
  std::size_t equal = 0;     ///< messages that share the stamp of the one before
  std::size_t longest_run = 1;
  double interval_s = 0;  ///< median of those between different stamps
  std::size_t gaps = 0;
  double longest_gap_s = 0;
  double duration_s = 0;  ///< sum of the intervals
};

StampStatistics statisticsOf(const std::vector<DoctorTime>& times);

template <class Messages>
std::vector<DoctorTime> timesOf(const Messages& messages) {
  std::vector<DoctorTime> times;
  times.reserve(messages.size());
  for (const auto& message : messages) times.push_back(message.time);
  return times;
}

struct StreamName {
  std::string id;    ///< of the checks
  std::string what;  ///< for messages
};

/// `ID_rate`: gaps, too few messages. @param remedy  of a rate below `slowest_hz`
Finding checkRate(const StreamName& name, const StampStatistics& s, double slowest_hz,
                  const std::string& remedy);
/// `ID_stamps`: zero, backward, begun anew. @param equal_counts  equal ones are a fault, too
Finding checkStamps(const StreamName& name, const StampStatistics& s, bool equal_counts);
/// `ID_bursts`: several messages with one stamp.
Finding checkBursts(const StreamName& name, const StampStatistics& s);

double medianOf(std::vector<double> values);
std::string rounded(double value, int digits);
std::string percent(std::size_t part, std::size_t all);

}  // namespace ardrone_vslam
