// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/doctor_examination.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "doctor/camera/doctor_camera.hpp"
#include "doctor/camera/doctor_frames.hpp"
#include "doctor/camera/doctor_motion.hpp"
#include "doctor/camera/doctor_tracks.hpp"
#include "doctor/recording/doctor_topics.hpp"
#include "doctor/streams/adapted_odometry.hpp"
#include "doctor/streams/doctor_height.hpp"
#include "doctor/streams/doctor_navdata.hpp"
#include "doctor/streams/doctor_odometry.hpp"
#include "doctor/streams/doctor_streams.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kCar_m_s = 4;  // in the mean: a car

void append(Findings& findings, Findings more) {
  for (Finding& finding : more) findings.push_back(std::move(finding));
}

/// The first reason for a parameter stays.
void removeRepeated(std::vector<SuggestedParameter>& parameters) {
  std::vector<SuggestedParameter> kept;
  for (const SuggestedParameter& parameter : parameters) {
    const bool is_there = std::any_of(kept.begin(), kept.end(), [&](const auto& other) {
      return other.section == parameter.section && other.key == parameter.key;
    });
    if (!is_there) kept.push_back(parameter);
  }
  parameters = std::move(kept);
}

double meanSpeed_m_s(const std::vector<OdometryState>& odometry) {
  double displacement_m = 0;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    displacement_m +=
        (odometry[i].T_odom_base.translation() - odometry[i - 1].T_odom_base.translation()).norm();
  }
  if (odometry.size() < 2) return 0;
  return displacement_m /
         (static_cast<double>(odometry.back().stamp_ns - odometry.front().stamp_ns) * 1e-9);
}

void nameVehicle(const DoctorRecording& recording, const std::vector<OdometryState>& odometry,
                 DoctorReport& report) {
  if (!recording.navdata_topic.empty() ||
      recording.base_frame.find("ardrone_base_link") != std::string::npos) {
    report.vehicle = "an AR.Drone";
    report.config_file = "ardrone.yaml";
  } else if (meanSpeed_m_s(odometry) > kCar_m_s) {
    report.vehicle = "a car";
    report.config_file = "kitti.yaml";
    // That file has a car's noise.
    const auto isNoise = [](const SuggestedParameter& p) { return p.key.rfind("walk_", 0) == 0; };
    report.parameters.erase(
        std::remove_if(report.parameters.begin(), report.parameters.end(), isNoise),
        report.parameters.end());
  }
}

bool isFound(const Findings& findings, const std::string& check) {
  return std::any_of(findings.begin(), findings.end(), [&check](const Finding& finding) {
    return finding.check == check && finding.verdict == Verdict::kWarning;
  });
}

/// Of the scale, for which a configuration may take navdata's.
void suggestHeights(const DoctorRecording& recording, const Findings& findings,
                    std::vector<SuggestedParameter>& parameters) {
  const bool has_none = recording.navdata.empty();
  if (!has_none && !isFound(findings, "navdata_height")) return;
  const std::string reason = has_none ? "there is no navdata" : "navdata's height is no use";
  parameters.push_back({"mapper", "use_navdata_height", "false", reason});
  parameters.push_back({"mapper", "floor_points", "false", "they need a height"});
}

std::string shellWord(const std::string& word) {
  const bool is_plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) ||
           std::string("/._-+,:@%=").find(static_cast<char>(c)) != std::string::npos;
  });
  if (is_plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Takes the topics that were looked at, and the parameters that were found.
std::string replayLine(const DoctorRecording& recording, const DoctorReport& report) {
  const std::string stem = std::filesystem::path(recording.name).stem().string();
  std::string line = "rosrun ardrone_vslam replay " + shellWord(recording.name) + " --out " +
                     shellWord(stem + "_run");
  if (!report.in_force.empty()) {
    line += " --config " + shellWord(report.in_force);
  } else if (!report.config_file.empty()) {
    line += " --config $(rospack find ardrone_vslam)/config/" + report.config_file;
  }
  for (const std::string& option : recording.replay_options) line += " " + option;
  for (const SuggestedParameter& parameter : report.parameters) {
    // Of the images' transport replay knows by the topic's type.
    if (parameter.key == "image_transport") continue;
    line += " --set " + parameter.section + "/" + parameter.key + "=" + parameter.value;
  }
  return line;
}

Finding aboutTracks(const DoctorRecording& recording, const Tracks& tracks) {
  Finding finding{"images_tracked", Verdict::kOk, {}, {}};
  finding.text = text(tracks.looked_at, " of ", recording.images.size(), " images");
  if (tracks.looked_at == 0) {
    return {"images_tracked",
            Verdict::kNotChecked,
            "because no image has a calibration that can be used",
            {}};
  }
  if (tracks.undecodable == 0) return finding;
  finding.verdict = Verdict::kWarning;
  finding.text += text(", ", tracks.undecodable, " cannot be decoded");
  finding.remedy = "record them again";
  return finding;
}

}  // namespace

DoctorReport examine(const DoctorRecording& recording,
                     const std::function<void(std::size_t done)>& progress,
                     const DoctorConfiguration& in_force) {
  DoctorReport report;
  report.name = recording.name;
  Findings& findings = report.findings;
  std::vector<SuggestedParameter>& parameters = report.parameters;
  findings.push_back(checkTopics(recording));
  append(findings, checkImageStream(recording));
  append(findings, checkOdometryStream(recording));
  append(findings, checkNavdataStreams(recording));
  findings.push_back(checkClock(recording));
  findings.push_back(checkPairing(recording));
  append(findings, checkCalibrations(recording));
  if (std::any_of(recording.calibrations.begin(), recording.calibrations.end(), needsRescaling)) {
    parameters.push_back(
        {"tracker", "rescale_calibration", "true", "K was made at another size than the images'"});
  }
  findings.push_back(checkCameraSwitch(recording));
  findings.push_back(checkOdometryFrames(recording, parameters));
  append(findings, checkCameraTf(recording, report.static_transform));
  append(findings, checkOdometryValues(recording));
  append(findings, checkOdometryFields(recording, parameters));
  findings.push_back(checkOdometryYaw(recording, parameters));
  const bool is_mirrored = isFound(findings, "odometry_yaw") && parameters.back().value == "twist";
  append(findings, checkHeight(recording, parameters));
  append(findings, checkNavdataValues(recording));
  suggestHeights(recording, findings, parameters);
  if (isNavdataTheOdometry(recording)) {
    parameters.push_back(
        {"mapper", "odometry_mode", "navdata", "there is no odometry; navdata and IMU make one"});
    findings.front().answered_by = {parameters.back()};
  }

  const Tracks tracks = trackImages(recording, progress);
  findings.push_back(aboutTracks(recording, tracks));
  // Whole metres are no motion to hold against the images.
  const OdometryHeight height =
      isFound(findings, "height_metres") ? OdometryHeight::kTwist : OdometryHeight::kPose;
  const AdaptedOdometry odometry =
      isNavdataTheOdometry(recording)
          ? observeNavdata(recording)
          : adapt(recording, is_mirrored ? OdometryMode::kTwist : OdometryMode::kPose, height);
  findings.push_back(checkMoves(recording, tracks, odometry.states));
  const auto cameras = estimateAllExtrinsics(recording, tracks, odometry.states);
  append(findings, checkDirections(cameras, recording.base_frame, report.static_transform));
  findings.push_back(checkTimeOffset(cameras, parameters));
  if (!parameters.empty() && parameters.back().key == "image_time_offset_s") {
    SuggestedParameter of_tracker = parameters.back();  // for use_attitude
    of_tracker.section = "tracker";
    parameters.push_back(of_tracker);
  }
  nameVehicle(recording, odometry.states, report);
  if (isCompressed(recording)) {
    parameters.push_back({"tracker", "image_transport", "compressed", "there are no raw images"});
  }
  removeRepeated(parameters);
  compareWith(in_force, report);
  if (!recording.is_live && report.canWork()) report.replay = replayLine(recording, report);
  return report;
}

}  // namespace ardrone_vslam
