// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_frames.hpp"

#include <algorithm>
#include <array>
#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <cstdio>

#include "ardrone_vslam/setup_watch.hpp"
#include "ardrone_vslam/slam.hpp"
#include "input_checks/checked.hpp"
#include "sequences/drone_cameras.hpp"
#include "sequences/sequence.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kFar_m = 5;              // from base, for a camera of a drone or car
constexpr double kNoRotation_rad = 0.05;  // of a transform whose turn was left out

/// A frame of the tree that is `frame` with a prefix; empty: none, or several.
std::string prefixed(const DoctorRecording& recording, const std::string& frame) {
  std::string found;
  const std::string end = "/" + frame;
  const auto look = [&](const std::string& name) {
    const bool fits = boost::algorithm::ends_with(name, end) && name != end;
    if (fits && name != found) found = found.empty() ? name : std::string();
  };
  for (const auto& edge : recording.transforms) {
    look(edge.first);
    look(edge.second.parent);
  }
  return found;
}

/// Where such a camera most likely sits.
Eigen::Isometry3d usualExtrinsics(const std::string& camera_frame) {
  if (boost::algorithm::ends_with(camera_frame, "ardrone_base_frontcam"))
    return cameraNamed("front").T_body_cam;
  if (boost::algorithm::ends_with(camera_frame, "ardrone_base_bottomcam"))
    return cameraNamed("bottom").T_body_cam;
  return forwardCamera();
}

}  // namespace

std::vector<std::string> cameraFrames(const DoctorRecording& recording) {
  std::vector<std::string> frames;
  for (const DoctorImage& image : recording.images) {
    if (std::find(frames.begin(), frames.end(), image.frame) == frames.end()) {
      frames.push_back(image.frame);
    }
  }
  return frames;
}

namespace {

void warnOfSecondParent(const DoctorRecording& recording, const std::string& frame,
                        Finding& finding) {
  const auto edge = recording.transforms.find(frame);
  if (edge == recording.transforms.end() || edge->second.other_parent.empty()) return;
  finding.verdict = Verdict::kWarning;
  finding.text += text("; '", frame, "' has two parents in tf, '", edge->second.parent, "' and '",
                       edge->second.other_parent, "'");
  finding.remedy = "stop one of the two that publish it (tf is a tree)";
  finding.answered_by.clear();
}

}  // namespace

Finding checkOdometryFrames(const DoctorRecording& recording,
                            std::vector<SuggestedParameter>& parameters) {
  Finding finding{"odometry_frames", Verdict::kOk, {}, {}};
  if (recording.odometry.empty()) {
    return {"odometry_frames", Verdict::kNotChecked, "needs odometry", {}};
  }
  const std::string &odom = recording.odom_frame, &base = recording.base_frame;
  finding.text = text("'", odom, "' -> '", base, "'");
  if (base.empty()) {
    finding.verdict = Verdict::kFault;
    finding.text = "the odometry has no child_frame_id, so nobody knows what it is the pose of";
    finding.remedy = "let its source fill it, or set base_frame";
    parameters.push_back({"mapper", "base_frame", "base_link", "the odometry names none"});
    return finding;
  }
  if (recording.transforms.empty()) {
    return {"odometry_frames", Verdict::kNotChecked, "needs tf", {}};
  }
  std::string missing;
  const auto compare = [&](const std::string& frame, const std::string& key) {
    if (frame.empty() || isInTree(recording, frame)) return;
    const std::string whole = prefixed(recording, frame);
    if (whole.empty()) return;
    missing += text(missing.empty() ? "" : ", ", "'", frame, "' (tf: '", whole, "')");
    parameters.push_back({"mapper", key, whole, "the odometry leaves out tf's prefix"});
    finding.answered_by.push_back(parameters.back());
  };
  compare(odom, "odom_frame");
  compare(base, "base_frame");
  const auto up = recording.transforms.find(base);
  if (!missing.empty()) {
    finding.verdict = Verdict::kWarning;
    finding.text = "frames without tf's prefix: " + missing;
    finding.remedy = "set the parameters below";
  } else if (odom.empty()) {
    finding.verdict = Verdict::kWarning;
    finding.text = "the odometry has no frame_id";
    finding.remedy = "let its source fill it, or set odom_frame";
  } else if (up != recording.transforms.end() && up->second.parent != odom &&
             !lookUp(recording, odom, base)) {
    finding.verdict = Verdict::kWarning;
    finding.text += text(", but tf has '", up->second.parent, "' -> '", base, "'");
    finding.remedy = "let one name be used for both";
  }
  for (const std::string& frame : {odom, base}) warnOfSecondParent(recording, frame, finding);
  return finding;
}

Findings checkCameraTf(const DoctorRecording& recording, std::string& static_transform) {
  if (recording.images.empty() || recording.base_frame.empty()) {
    return {{"camera_tf", Verdict::kNotChecked, "needs images, and a base frame of odometry", {}}};
  }
  Findings findings;
  const std::string& base = recording.base_frame;
  for (const std::string& camera : cameraFrames(recording)) {
    Finding finding{"camera_tf", Verdict::kOk, {}, {}};
    const auto T_base_cam = lookUp(recording, base, camera);
    if (camera.empty() || !T_base_cam) {
      static_transform = staticTransformLine(usualExtrinsics(camera), base, camera);
      finding.verdict = Verdict::kFault;
      finding.text = camera.empty() ? "the images have no frame_id"
                                    : text("tf has no way from '", base, "' to '", camera, "'");
      finding.remedy =
          "publish (and record) the camera's mounting; of a usual one: " + static_transform;
      findings.push_back(finding);
      continue;
    }
    const Eigen::Vector3d& t = T_base_cam->translation();
    finding.text =
        text("'", base, "' -> '", camera, "': (", t.x(), ", ", t.y(), ", ", t.z(), ") m");
    const std::string fault = extrinsicsFault(*T_base_cam);
    if (!fault.empty()) {
      finding.verdict = Verdict::kFault;
      finding.text += ": " + fault;
    } else if (t.norm() > kFar_m) {
      finding.verdict = Verdict::kWarning;
      finding.text += text(": ", t.norm(), " m from base");
      finding.remedy = "check the transform; metres are asked for";
    } else if (Eigen::AngleAxisd(T_base_cam->linear()).angle() < kNoRotation_rad) {
      finding.verdict = Verdict::kWarning;
      finding.text +=
          " and no turn, so that the camera would look up: its axes must be the optical "
          "ones (x right, y down, z forward)";
      finding.remedy = "see camera_direction";
    }
    findings.push_back(finding);
  }
  return findings;
}

}  // namespace ardrone_vslam
