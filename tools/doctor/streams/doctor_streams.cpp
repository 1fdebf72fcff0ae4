// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/doctor_streams.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "doctor/recording/doctor_stamps.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSlowestImages_hz = 3;  // tracks last at it (test FrameRate)
constexpr double kSlowestOdometry_hz = 5;
constexpr double kSameClock_s = 0.3;    // by which two topics' latencies may differ
constexpr double kOld_s = 60;           // older stamps are not of this time
constexpr double kFuture_s = 0.05;      // stamps are not later than their reception
constexpr double kFewestOverlap = 0.5;  // of the images within the odometry's time
constexpr double kEnoughOverlap = 0.9;

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
    if (time.stamp_ns > 0)
      latencies_s.push_back(static_cast<double>(time.received_ns - time.stamp_ns) * 1e-9);
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
  need(odometryTopic(recording), "odometry (nav_msgs/Odometry)");
  if (!missing.empty()) {
    finding.verdict = Verdict::kFault;
    finding.text = "no topic for " + missing + "; there are: " + (all.empty() ? "none" : all);
    finding.remedy = "record them, or name them by --image, --camera-info, --odometry";
    return finding;
  }
  finding.text =
      recording.image_topic + ", " + recording.camera_info_topic + ", " + odometryTopic(recording);
  if (isNavdataTheOdometry(recording)) {
    finding.verdict = Verdict::kWarning;
    finding.text += recording.imu_topic.empty() ? std::string() : ", " + recording.imu_topic;
    finding.text += "; no odometry (nav_msgs/Odometry), but the drone's navdata takes its place";
    finding.remedy = "odometry_mode: navdata (replay --set mapper/odometry_mode=navdata; live: " +
                     text("ardrone.launch navdata:=", recording.navdata_topic) + ")";
  }
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
          checkStamps(name, s, false), checkBursts(name, s)};
}

namespace {

/// Images whose stamp lies within the time of these.
std::size_t imagesWithin(const DoctorRecording& recording, const std::vector<DoctorTime>& times) {
  std::int64_t begin_ns = 0, end_ns = 0;
  for (const DoctorTime& time : times) {
    const std::int64_t stamp_ns = time.stamp_ns;
    if (stamp_ns <= 0) continue;
    if (begin_ns == 0 || stamp_ns < begin_ns) begin_ns = stamp_ns;
    end_ns = std::max(end_ns, stamp_ns);
  }
  const auto is_within = [&](const DoctorImage& image) {
    return image.time.stamp_ns >= begin_ns && image.time.stamp_ns <= end_ns;
  };
  return static_cast<std::size_t>(
      std::count_if(recording.images.begin(), recording.images.end(), is_within));
}

}  // namespace

Finding checkClock(const DoctorRecording& recording) {
  Finding finding{"clock", Verdict::kOk, {}, {}};
  const auto images_s = medianLatency_s(timesOf(recording.images));
  const std::vector<DoctorTime> odometry =
      isNavdataTheOdometry(recording) ? timesOf(recording.navdata) : timesOf(recording.odometry);
  const std::string what = isNavdataTheOdometry(recording) ? "navdata" : "odometry";
  const auto odometry_s = medianLatency_s(odometry);
  if (!images_s || !odometry_s) {
    return {"clock", Verdict::kNotChecked, "needs images and odometry with stamps", {}};
  }
  const double apart_s = *images_s - *odometry_s;
  const std::size_t within = imagesWithin(recording, odometry);
  const double share = static_cast<double>(within) / static_cast<double>(recording.images.size());
  finding.text = text("received after the stamp: images ", rounded(*images_s, 3), " s, ", what, " ",
                      rounded(*odometry_s, 3), " s in the median");
  if (std::min(*images_s, *odometry_s) > kOld_s) {
    finding.text = text("of a bag that is played or was recorded anew; images come ",
                        rounded(apart_s, 3), " s later after their stamp than ", what);
  }
  if (share < kEnoughOverlap) {
    finding.verdict = share < kFewestOverlap ? Verdict::kFault : Verdict::kWarning;
    finding.text =
        text("only ", percent(within, recording.images.size()),
             " of the images have a stamp within the time of the ", what, "; ", finding.text);
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
