// SPDX-License-Identifier: BSD-3-Clause
#include "doctor_streams.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>

#include "../../nodes/checked.hpp"  // no ROS

namespace ardrone_vslam {
namespace {

constexpr double kSlowestImages_hz = 3;  // docs/data_path.md: the lowest useful rate
constexpr double kSlowestOdometry_hz = 5;
constexpr double kGap_intervals = 5;
constexpr double kGap_s = 0.25;  // shorter ones are no gap at any rate
constexpr std::int64_t kRestart_ns = 1'000'000'000;
constexpr double kBurstShare = 0.01;    // of the messages
constexpr double kSameClock_s = 0.3;    // by which two topics' latencies may differ
constexpr double kOld_s = 60;           // older stamps are not of this time
constexpr double kFuture_s = 0.05;      // stamps are not later than their reception
constexpr double kFewestOverlap = 0.5;  // of the images within the odometry's time
constexpr double kEnoughOverlap = 0.9;

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

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

/// How the stamps of a topic follow each other.
struct StampStatistics {
  std::size_t messages = 0;
  std::size_t without = 0;   // stamps of zero
  std::size_t backward = 0;  // less than a second before the newest
  std::size_t restarts = 0;  // further before it
  std::size_t equal = 0;     // messages that share the stamp of the one before
  std::size_t longest_run = 1;
  double interval_s = 0;  // median of those between different stamps
  std::size_t gaps = 0;
  double longest_gap_s = 0;
  double duration_s = 0;  // sum of the intervals
};

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
  if (intervals_s.empty()) return s;
  s.interval_s = medianOf(intervals_s);
  for (const double interval_s : intervals_s) {
    s.duration_s += interval_s;
    if (interval_s <= std::max(kGap_s, kGap_intervals * s.interval_s)) continue;
    ++s.gaps;
    s.longest_gap_s = std::max(s.longest_gap_s, interval_s);
  }
  return s;
}

struct StreamName {
  std::string id;    // of the checks
  std::string what;  // for messages
};

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

Finding checkBursts(const StampStatistics& s) {
  Finding finding{"odometry_bursts", Verdict::kOk, "each message has a stamp of its own", {}};
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

template <class Messages>
std::vector<DoctorTime> timesOf(const Messages& messages) {
  std::vector<DoctorTime> times;
  for (const auto& message : messages) times.push_back(message.time);
  return times;
}

Finding checkImageFormat(const DoctorRecording& recording) {
  Finding finding{"image_format", Verdict::kOk, {}, {}};
  std::size_t bad = 0;
  std::string example;
  std::set<std::string> sizes;
  for (const DoctorImage& image : recording.images) {
    if (image.fault.empty()) {
      sizes.insert(text(image.width_px, "x", image.height_px));
    } else {
      ++bad;
      example = image.fault;
    }
  }
  for (const std::string& size : sizes) finding.text += (finding.text.empty() ? "" : ", ") + size;
  if (bad == 0) return finding;
  finding.verdict = bad == recording.images.size() ? Verdict::kFault : Verdict::kWarning;
  finding.text = text(bad, " of ", recording.images.size(), " images cannot be used: ", example);
  finding.remedy = "record them again, or convert them to mono8";
  return finding;
}

}  // namespace

std::optional<double> medianLatency_s(const std::vector<DoctorTime>& times) {
  std::vector<double> latencies_s;
  for (const DoctorTime& time : times) {
    if (time.stamp_ns > 0) latencies_s.push_back(seconds(time.received_ns - time.stamp_ns));
  }
  if (latencies_s.empty()) return std::nullopt;
  return medianOf(std::move(latencies_s));
}

Finding checkTopics(const DoctorRecording& recording) {
  Finding finding{"topics", Verdict::kOk, {}, {}};
  std::string all;
  for (const auto& topic : recording.topics) {
    all += (all.empty() ? "" : ", ") + topic.first + " (" + topic.second.type + ")";
  }
  std::string missing;
  const auto need = [&missing](const std::string& topic, const std::string& what) {
    if (topic.empty()) missing += (missing.empty() ? "" : ", ") + what;
  };
  need(recording.image_topic, "images (sensor_msgs/Image or CompressedImage)");
  need(recording.camera_info_topic, "the calibration (sensor_msgs/CameraInfo)");
  need(recording.odometry_topic, "odometry (nav_msgs/Odometry)");
  if (!missing.empty()) {
    finding.verdict = Verdict::kFault;
    finding.text = "no topic for " + missing + "; there are: " + (all.empty() ? "none" : all);
    finding.remedy = "record them, or name them by --image, --camera-info, --odometry";
    return finding;
  }
  finding.text =
      recording.image_topic + ", " + recording.camera_info_topic + ", " + recording.odometry_topic;
  for (const std::string& choice : recording.choices) finding.text += "; " + choice;
  return finding;
}

Findings checkImageStream(const DoctorRecording& recording) {
  if (recording.image_topic.empty()) return {};
  const StreamName name{"image", "images"};
  const StampStatistics s = statisticsOf(timesOf(recording.images));
  if (s.messages == 0) {
    return {{"image_rate", Verdict::kFault, recording.image_topic + " holds no image",
             "start the camera before recording"}};
  }
  return {checkRate(name, s, kSlowestImages_hz, "tracks do not last that long: raise the rate"),
          checkStamps(name, s, true), checkImageFormat(recording)};
}

Findings checkOdometryStream(const DoctorRecording& recording) {
  if (recording.odometry_topic.empty()) return {};
  const StreamName name{"odometry", "messages"};
  const StampStatistics s = statisticsOf(timesOf(recording.odometry));
  if (s.messages == 0) {
    return {{"odometry_rate", Verdict::kFault, recording.odometry_topic + " holds no message",
             "start what publishes it before recording"}};
  }
  return {checkRate(name, s, kSlowestOdometry_hz,
                    "turns between the messages are lost: raise the rate"),
          checkStamps(name, s, false), checkBursts(s)};
}

Finding checkClock(const DoctorRecording& recording) {
  Finding finding{"clock", Verdict::kOk, {}, {}};
  const auto images_s = medianLatency_s(timesOf(recording.images));
  const auto odometry_s = medianLatency_s(timesOf(recording.odometry));
  if (!images_s || !odometry_s) {
    return {"clock", Verdict::kNotChecked, "needs images and odometry with stamps", {}};
  }
  const double apart_s = *images_s - *odometry_s;
  std::int64_t begin_ns = 0, end_ns = 0;
  for (const DoctorOdometry& odometry : recording.odometry) {
    const std::int64_t stamp_ns = odometry.time.stamp_ns;
    if (stamp_ns <= 0) continue;
    if (begin_ns == 0 || stamp_ns < begin_ns) begin_ns = stamp_ns;
    end_ns = std::max(end_ns, stamp_ns);
  }
  std::size_t within = 0;
  for (const DoctorImage& image : recording.images) {
    if (image.time.stamp_ns >= begin_ns && image.time.stamp_ns <= end_ns) ++within;
  }
  const double share = static_cast<double>(within) / static_cast<double>(recording.images.size());
  finding.text = text("received after the stamp: images ", rounded(*images_s, 3), " s, odometry ",
                      rounded(*odometry_s, 3), " s in the median");
  if (std::min(*images_s, *odometry_s) > kOld_s) {
    finding.text = text("of a bag that is played or was recorded anew; images come ",
                        rounded(apart_s, 3), " s later after their stamp than odometry");
  }
  if (share < kEnoughOverlap) {
    finding.verdict = share < kFewestOverlap ? Verdict::kFault : Verdict::kWarning;
    finding.text = text("only ", percent(within, recording.images.size()),
                        " of the images have a stamp within the odometry's time; ", finding.text);
    finding.remedy = "record both at once, and set both computers' clocks (chrony)";
  } else if (std::abs(apart_s) > kSameClock_s) {
    finding.verdict = Verdict::kWarning;
    finding.text += text(": by two clocks, ", rounded(apart_s, 2), " s apart, or one comes late");
    finding.remedy = "set both computers' clocks (chrony), or stamp both at reception";
  } else if (std::min(*images_s, *odometry_s) < -kFuture_s) {
    finding.verdict = Verdict::kWarning;
    finding.text += ": stamps in the future";
    finding.remedy = "set the clocks of the computers that publish and record (chrony)";
  }
  return finding;
}

}  // namespace ardrone_vslam
