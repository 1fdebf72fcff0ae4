// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_camera.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kPairedEnough = 0.98;
constexpr double kPairedFewest = 0.1;
constexpr double kOffCentre = 0.1;      // of the image's size: no usual camera
constexpr double kFarOffCentre = 0.16;  // no camera: K was made at another size
constexpr double kAspect = 0.1;         // by which fx and fy may differ

const char* const kCalibrate =
    "calibrate at the size that is streamed (camera_calibration), or scale K by hand: "
    "fx, cx by the widths, fy, cy by the heights";

/// Stamp -> calibration, ascending.
std::map<std::int64_t, std::size_t> byStamp(const DoctorRecording& recording) {
  std::map<std::int64_t, std::size_t> calibrations;
  for (const DoctorCameraInfo& info : recording.camera_infos) {
    calibrations[info.time.stamp_ns] = info.calibration;
  }
  return calibrations;
}

/// How far the principal point is from the middle, in image sizes.
double offCentre(const CameraIntrinsics& c) {
  const double off_x = (c.cx_px + 0.5) / c.width_px - 0.5;
  const double off_y = (c.cy_px + 0.5) / c.height_px - 0.5;
  return std::max(std::abs(off_x), std::abs(off_y));
}

Finding judgeCentre(const CameraIntrinsics& c, const std::string& which) {
  Finding finding{"calibration", Verdict::kOk, {}, {}};
  const double off = offCentre(c);
  finding.text = text(which, c.width_px, "x", c.height_px, ", f = ", c.fx_px, " px, centre (",
                      c.cx_px, ", ", c.cy_px, ")");
  if (off > kFarOffCentre) {
    finding.verdict = Verdict::kFault;
    finding.text +=
        text(": its centre would suit an image of about ", std::lround(2 * c.cx_px), "x",
             std::lround(2 * c.cy_px), ", so K was made at another size and not rescaled");
    finding.remedy = text(kCalibrate, ", or set rescale_calibration: true");
  } else if (off > kOffCentre) {
    finding.verdict = Verdict::kWarning;
    finding.text += ": its centre is far from the image's middle";
    finding.remedy = "check that it is this camera's, at this size";
  } else if (std::abs(c.fx_px / c.fy_px - 1) > kAspect) {
    finding.verdict = Verdict::kWarning;
    finding.text += text(": fy is ", c.fy_px, " px, so its pixels would not be square");
    finding.remedy = "check the calibration, or whether the images are squeezed";
  }
  return finding;
}

Finding judgeRescaled(const DoctorCalibration& calibration, const std::string& which) {
  const CameraIntrinsics& told = calibration.camera;
  Finding finding = judgeCentre(usedCamera(calibration), which + "rescaled to ");
  finding.verdict = Verdict::kWarning;
  finding.text += text("; its K's centre, (", told.cx_px, ", ", told.cy_px,
                       "), would suit an image of about ", std::lround(2 * told.cx_px), "x",
                       std::lround(2 * told.cy_px), ", so K was made at another size");
  finding.remedy = text("set rescale_calibration to true; or ", kCalibrate);
  finding.answered_by = {
      {"tracker", "rescale_calibration", "true", "K was made at another size than the images'"}};
  return finding;
}

/// Whether all pixels have a bearing.
Finding judgeLens(const CameraIntrinsics& c, const std::string& which) {
  const CameraModel model(c);
  const auto hasBearing = [&model](int x, int y) {
    return model.bearing({static_cast<double>(x), static_cast<double>(y)}).has_value();
  };
  int without = 0, all = 0;
  constexpr int kStep_px = 8;
  for (int y = 0; y < c.height_px; y += kStep_px) {
    for (int x = 0; x < c.width_px; x += kStep_px, ++all) without += hasBearing(x, y) ? 0 : 1;
  }
  if (without == 0) {
    return {"lens", Verdict::kOk, which + "the distortion model holds in the whole image", {}};
  }
  return {"lens", Verdict::kWarning,
          text(which, "the distortion model (k1 ", c.k1, ", k2 ", c.k2, ", k3 ", c.k3,
               ") folds back within the image: ", 100 * without / all,
               " % of the pixels have no direction, their corners are not used"),
          "calibrate with the board seen up to the image's corners"};
}

Finding judgeSize(const DoctorRecording& recording, std::size_t calibration,
                  const std::string& which) {
  const CameraIntrinsics& camera = recording.calibrations[calibration].camera;
  std::size_t other = 0, all = 0;
  std::string example;
  for (std::size_t i = 0; i < recording.images.size(); ++i) {
    const DoctorImage& image = recording.images[i];
    if (!image.fault.empty() || calibrationOf(recording, i) != calibration) continue;
    ++all;
    if (image.width_px == camera.width_px && image.height_px == camera.height_px) continue;
    ++other;
    example = text(image.width_px, "x", image.height_px);
  }
  if (other == 0) return {};
  return {"calibration", other == all ? Verdict::kFault : Verdict::kWarning,
          text(which, other, " of ", all, " images are ", example, ", the calibration is for ",
               camera.width_px, "x", camera.height_px),
          kCalibrate};
}

}  // namespace

std::optional<std::size_t> calibrationOf(const DoctorRecording& recording, std::size_t image) {
  const auto& infos = recording.camera_infos;
  if (recording.calibrations.size() == 1) return 0;
  const std::int64_t stamp_ns = recording.images[image].time.stamp_ns;
  // Ascending but for damaged recordings, where a later one may be missed.
  const auto at =
      std::lower_bound(infos.begin(), infos.end(), stamp_ns,
                       [](const auto& info, std::int64_t ns) { return info.time.stamp_ns < ns; });
  if (at == infos.end() || at->time.stamp_ns != stamp_ns) return std::nullopt;
  return at->calibration;
}

bool isPlausible(const CameraIntrinsics& camera) {
  return offCentre(camera) <= kFarOffCentre;
}

bool needsRescaling(const DoctorCalibration& calibration) {
  const bool is_usable = calibration.fault.empty() && isPlausible(calibration.camera);
  return !is_usable && calibration.rescaled && isPlausible(*calibration.rescaled);
}

const CameraIntrinsics& usedCamera(const DoctorCalibration& calibration) {
  return needsRescaling(calibration) ? *calibration.rescaled : calibration.camera;
}

Finding checkPairing(const DoctorRecording& recording) {
  Finding finding{"camera_info", Verdict::kOk, {}, {}};
  if (recording.images.empty() || recording.camera_info_topic.empty()) {
    return {"camera_info", Verdict::kNotChecked, "needs images and camera_info", {}};
  }
  const auto infos = byStamp(recording);
  std::size_t paired = 0;
  for (const DoctorImage& image : recording.images) paired += infos.count(image.time.stamp_ns);
  const double share = static_cast<double>(paired) / static_cast<double>(recording.images.size());
  finding.text = text(paired, " of ", recording.images.size(), " images have one of their stamp");
  // The ends of a recording may cut one off.
  if (share >= kPairedEnough || paired + 2 >= recording.images.size()) return finding;
  finding.verdict = share < kPairedFewest ? Verdict::kFault : Verdict::kWarning;
  finding.remedy =
      "the tracker needs a camera_info with each image's stamp: let the driver publish them "
      "together (replay takes the first one for all)";
  return finding;
}

namespace {

/// The findings on the i-th calibration. @param which  of several, for their texts
Findings checkCalibration(const DoctorRecording& recording, std::size_t i,
                          const std::string& which) {
  const DoctorCalibration& calibration = recording.calibrations[i];
  const bool is_rescaled = needsRescaling(calibration);
  if (!calibration.fault.empty() && !is_rescaled)
    return {{"calibration", Verdict::kFault, which + calibration.fault, kCalibrate}};
  Findings findings{judgeSize(recording, i, which)};
  if (findings.front().check.empty()) {
    findings.front() =
        is_rescaled ? judgeRescaled(calibration, which) : judgeCentre(calibration.camera, which);
  }
  const CameraIntrinsics& camera = usedCamera(calibration);
  if (isPlausible(camera)) findings.push_back(judgeLens(camera, which));
  return findings;
}

/// How an image's camera is called; two that differ are two cameras.
std::string cameraOf(const DoctorImage& image, const std::optional<std::size_t>& calibration) {
  return text(image.frame, " ", image.width_px, "x", image.height_px,
              calibration ? text(" with calibration ", *calibration + 1) : std::string());
}

std::string listOf(const std::set<std::string>& cameras) {
  std::string list;
  for (const std::string& camera : cameras) list += (list.empty() ? "" : ", ") + camera;
  return list;
}

}  // namespace

Findings checkCalibrations(const DoctorRecording& recording) {
  if (recording.calibrations.empty()) {
    if (recording.camera_info_topic.empty()) return {};
    return {{"calibration", Verdict::kFault, recording.camera_info_topic + " holds no message",
             "give the driver its calibration file"}};
  }
  Findings findings;
  for (std::size_t i = 0; i < recording.calibrations.size(); ++i) {
    const std::string which =
        recording.calibrations.size() == 1 ? "" : text("calibration ", i + 1, ": ");
    const Findings of_one = checkCalibration(recording, i, which);
    findings.insert(findings.end(), of_one.begin(), of_one.end());
  }
  return findings;
}

Finding checkCameraSwitch(const DoctorRecording& recording) {
  if (recording.images.empty()) {
    return {"camera_switch", Verdict::kNotChecked, "needs images", {}};
  }
  std::string before;
  std::set<std::string> cameras;
  std::size_t changes = 0;
  for (std::size_t i = 0; i < recording.images.size(); ++i) {
    const DoctorImage& image = recording.images[i];
    if (!image.fault.empty()) continue;
    const auto calibration = calibrationOf(recording, i);
    const std::string now = cameraOf(image, calibration);
    changes += !before.empty() && calibration && now != before ? 1 : 0;
    if (before.empty() || calibration) before = now;
    if (calibration || recording.calibrations.empty()) cameras.insert(now);
  }
  if (changes == 0) return {"camera_switch", Verdict::kOk, "one camera: " + before, {}};
  return {"camera_switch", Verdict::kWarning,
          text("the camera changes ", changes, " times: ", listOf(cameras)),
          "map and pose go on where each camera has a calibration and a tf of its own"};
}

}  // namespace ardrone_vslam
