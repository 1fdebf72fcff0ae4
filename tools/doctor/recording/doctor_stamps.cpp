// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/recording/doctor_stamps.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kGap_intervals = 5;
constexpr double kGap_s = 0.25;  // shorter ones are no gap at any rate
constexpr std::int64_t kRestart_ns = 1'000'000'000;
constexpr double kBurstShare = 0.01;  // of the messages

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

}  // namespace

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string rounded(double value, int digits) {
  std::ostringstream stream;
  stream << std::fixed << std::setprecision(digits) << value;
  return stream.str();
}

std::string percent(std::size_t part, std::size_t all) {
  return rounded(100.0 * static_cast<double>(part) / static_cast<double>(all), 1) + " %";
}

namespace {

void measure(const std::vector<double>& intervals_s, StampStatistics& s) {
  if (intervals_s.empty()) return;
  s.interval_s = medianOf(intervals_s);
  for (const double interval_s : intervals_s) {
    s.duration_s += interval_s;
    if (interval_s <= std::max(kGap_s, kGap_intervals * s.interval_s)) continue;
    ++s.gaps;
    s.longest_gap_s = std::max(s.longest_gap_s, interval_s);
  }
}

}  // namespace

StampStatistics statisticsOf(const std::vector<DoctorTime>& times) {
  StampStatistics s;
  s.messages = times.size();
  std::vector<double> intervals_s;
  std::int64_t newest_ns = 0;
  std::size_t run = 1;
  for (const DoctorTime& time : times) {
    const std::int64_t step_ns = time.stamp_ns - newest_ns;
    if (time.stamp_ns <= 0) {
      ++s.without;
      continue;
    }
    if (newest_ns != 0 && step_ns < 0 && step_ns > -kRestart_ns) {
      ++s.backward;
      continue;
    }
    if (newest_ns != 0 && step_ns < 0) {
      ++s.restarts;
    } else if (newest_ns != 0 && step_ns == 0) {
      ++s.equal;
      s.longest_run = std::max(s.longest_run, ++run);
      continue;
    } else if (newest_ns != 0) {
      intervals_s.push_back(seconds(step_ns));
    }
    newest_ns = time.stamp_ns;
    run = 1;
  }
  measure(intervals_s, s);
  return s;
}

Finding checkRate(const StreamName& name, const StampStatistics& s, double slowest_hz,
                  const std::string& remedy) {
  Finding finding{name.id + "_rate", Verdict::kOk, {}, {}};
  if (s.interval_s <= 0) {
    finding.verdict = Verdict::kFault;
    finding.text = text("only ", s.messages, " messages, without two different stamps");
    finding.remedy = "record for some seconds while the topic is published";
    return finding;
  }
  // Of what came, bursts included.
  const double rate_hz =
      static_cast<double>(s.messages - s.without - s.backward) / (s.duration_s + s.interval_s);
  finding.text = text(rounded(rate_hz, 1), " Hz for ", rounded(s.duration_s, 1), " s");
  if (s.gaps > 0) {
    finding.verdict = Verdict::kWarning;
    finding.text += text(", ", s.gaps, " gaps, the longest ", rounded(s.longest_gap_s, 2), " s");
    finding.remedy = "check the link and the recording computer's load (rosbag record -b 0)";
  }
  if (1 / s.interval_s < slowest_hz) {
    finding.verdict = Verdict::kWarning;
    finding.text += text(": slower than ", slowest_hz, " Hz");
    finding.remedy = remedy;
  }
  return finding;
}

Finding checkStamps(const StreamName& name, const StampStatistics& s, bool equal_counts) {
  Finding finding{name.id + "_stamps", Verdict::kOk, {}, {}};
  std::vector<std::string> parts;
  if (s.without > 0) parts.push_back(text(s.without, " without stamp"));
  if (s.backward > 0) parts.push_back(text(s.backward, " go back"));
  if (s.restarts > 0) parts.push_back(text(s.restarts, " times they began anew"));
  if (equal_counts && s.equal > 0) parts.push_back(text(s.equal, " have the stamp before"));
  if (parts.empty()) {
    finding.text = equal_counts ? "ascend" : "do not go back";
    return finding;
  }
  finding.verdict = 2 * s.without > s.messages ? Verdict::kFault : Verdict::kWarning;
  for (const std::string& part : parts) finding.text += (finding.text.empty() ? "" : ", ") + part;
  finding.text = text("of ", s.messages, " ", name.what, ": ", finding.text);
  finding.remedy = s.restarts > 0
                       ? "a bag that was played in a loop, or a clock that was set: record one run"
                       : "such messages are dropped: correct the stamps of the driver";
  return finding;
}

Finding checkBursts(const StreamName& name, const StampStatistics& s) {
  Finding finding{name.id + "_bursts", Verdict::kOk, "each message has a stamp of its own", {}};
  if (static_cast<double>(s.equal) <= kBurstShare * static_cast<double>(s.messages)) {
    if (s.equal > 0) finding.text = text(s.equal, " messages share the stamp before");
    return finding;
  }
  finding.verdict = Verdict::kWarning;
  finding.text = text(percent(s.equal, s.messages), " of the messages have the stamp of the one ",
                      "before, up to ", s.longest_run, " one stamp");
  finding.remedy =
      "the driver hands packets over in bursts: set its realtime_navdata (its launch file does); "
      "they are spread over the gap before meanwhile";
  return finding;
}

}  // namespace ardrone_vslam
