// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_camera.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/setup_watch.hpp"
#include "doctor/camera/doctor_frames.hpp"
#include "doctor/doctor_examination.hpp"
#include "sequences/drone_cameras.hpp"
#include "support/doctor_findings.hpp"
#include "support/doctor_recordings.hpp"

namespace ardrone_vslam {
namespace {

using test::goodRecording;
using test::verdictOf;
using Parameters = std::vector<SuggestedParameter>;

TEST(DoctorCamera, ASoundCalibrationHasNoFault) {
  const DoctorRecording good = goodRecording();
  EXPECT_EQ(checkPairing(good).verdict, Verdict::kOk);
  EXPECT_EQ(checkCameraSwitch(good).verdict, Verdict::kOk);
  for (const Finding& finding : checkCalibrations(good)) EXPECT_EQ(finding.verdict, Verdict::kOk);
  // Nor have the drone's own, as its driver gives them.
  DoctorRecording drone = goodRecording();
  drone.calibrations[0].camera = cameraNamed("front").intrinsics;
  for (const Finding& finding : checkCalibrations(drone)) EXPECT_EQ(finding.verdict, Verdict::kOk);
}

TEST(DoctorCamera, FindsImagesWithoutCameraInfo) {
  DoctorRecording some = goodRecording();
  some.camera_infos.resize(60);
  EXPECT_EQ(checkPairing(some).verdict, Verdict::kWarning);
  some.camera_infos.resize(1);
  EXPECT_EQ(checkPairing(some).verdict, Verdict::kFault);
  some.images.clear();
  EXPECT_EQ(checkPairing(some).verdict, Verdict::kNotChecked);
}

TEST(DoctorCamera, FindsAKThatWasNotRescaled) {
  for (const double scale : {0.5, 0.6, 1.6}) {
    DoctorRecording recording = goodRecording();
    CameraIntrinsics& camera = recording.calibrations[0].camera;
    camera.fx_px *= scale;
    camera.fy_px *= scale;
    camera.cx_px *= scale;
    camera.cy_px *= scale;
    const Findings findings = checkCalibrations(recording);
    EXPECT_EQ(verdictOf(findings, "calibration"), Verdict::kFault) << scale;
    EXPECT_EQ(findings.size(), 1U);  // its lens is not judged
    EXPECT_FALSE(isPlausible(camera));
  }
}

TEST(DoctorCamera, RescalesAKWhereThatMakesItPlausible) {
  DoctorRecording recording = goodRecording();
  DoctorCalibration& calibration = recording.calibrations[0];
  calibration.rescaled = calibration.camera;
  EXPECT_FALSE(needsRescaling(calibration));
  calibration.camera.fx_px = calibration.camera.fy_px = 1140;
  calibration.camera.cx_px = 640;
  calibration.camera.cy_px = 360;
  calibration.fault = "the principal point lies outside";
  EXPECT_TRUE(needsRescaling(calibration));
  const Findings findings = checkCalibrations(recording);
  EXPECT_EQ(verdictOf(findings, "calibration"), Verdict::kWarning);
  EXPECT_NE(findings[0].remedy.find("rescale_calibration"), std::string::npos);
  EXPECT_EQ(verdictOf(findings, "lens"), Verdict::kOk);
  const DoctorReport report = examine(recording, {});
  EXPECT_NE(report.replay.find("--set tracker/rescale_calibration=true"), std::string::npos)
      << textOf(report);
  // What is implausible rescaled, too, stays a fault.
  calibration.rescaled->cx_px = 500;
  EXPECT_FALSE(needsRescaling(calibration));
  EXPECT_EQ(verdictOf(checkCalibrations(recording), "calibration"), Verdict::kFault);
}

TEST(DoctorCamera, FindsAnotherSizeAndWhatTheTrackerRefuses) {
  DoctorRecording size = goodRecording();
  for (DoctorImage& image : size.images) image.width_px = 1280;
  EXPECT_EQ(verdictOf(checkCalibrations(size), "calibration"), Verdict::kFault);
  DoctorRecording refused = goodRecording();
  refused.calibrations[0].fault = "the camera is uncalibrated";
  EXPECT_EQ(verdictOf(checkCalibrations(refused), "calibration"), Verdict::kFault);
  refused.calibrations.clear();
  EXPECT_EQ(verdictOf(checkCalibrations(refused), "calibration"), Verdict::kFault);
}

TEST(DoctorCamera, FindsALensThatFoldsBackInTheImage) {
  DoctorRecording recording = goodRecording();
  recording.calibrations[0].camera.k1 = -0.9;
  EXPECT_EQ(verdictOf(checkCalibrations(recording), "lens"), Verdict::kWarning);
}

TEST(DoctorCamera, FindsASwitchOfTheCamera) {
  DoctorRecording recording = goodRecording();
  CameraIntrinsics bottom = test::doctorCamera();
  bottom.fx_px = bottom.fy_px = 633;
  recording.calibrations.push_back({bottom, {}});
  for (std::size_t i = 40; i < 80; ++i) {
    recording.images[i].frame = "bottom";
    recording.camera_infos[i].calibration = 1;
  }
  const Finding finding = checkCameraSwitch(recording);
  EXPECT_EQ(finding.verdict, Verdict::kWarning);
  EXPECT_NE(finding.text.find("2 times"), std::string::npos) << finding.text;
  EXPECT_EQ(cameraFrames(recording), (std::vector<std::string>{"cam", "bottom"}));
}

TEST(DoctorFrames, SoundFramesHaveNoFault) {
  Parameters parameters;
  std::string line;
  EXPECT_EQ(checkOdometryFrames(goodRecording(), parameters).verdict, Verdict::kOk);
  EXPECT_EQ(verdictOf(checkCameraTf(goodRecording(), line), "camera_tf"), Verdict::kOk);
  EXPECT_TRUE(parameters.empty());
  EXPECT_TRUE(line.empty());
}

TEST(DoctorFrames, FindsAMissingPrefix) {
  DoctorRecording recording = goodRecording();
  recording.transforms["base"].parent = "drone1/odom";
  Parameters parameters;
  EXPECT_EQ(checkOdometryFrames(recording, parameters).verdict, Verdict::kWarning);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].key + " " + parameters[0].value, "odom_frame drone1/odom");
}

TEST(DoctorFrames, FindsNamesThatDifferAndTwoParents) {
  DoctorRecording other = goodRecording();
  other.transforms["base"].parent = "world";
  Parameters parameters;
  EXPECT_EQ(checkOdometryFrames(other, parameters).verdict, Verdict::kWarning);
  DoctorRecording two = goodRecording();
  two.transforms["base"].other_parent = "map";
  EXPECT_EQ(checkOdometryFrames(two, parameters).verdict, Verdict::kWarning);
  DoctorRecording none = goodRecording();
  none.base_frame.clear();
  EXPECT_EQ(checkOdometryFrames(none, parameters).verdict, Verdict::kFault);
  // tf of the camera alone is enough for replay.
  DoctorRecording camera_only = goodRecording();
  camera_only.transforms.erase("base");
  EXPECT_EQ(checkOdometryFrames(camera_only, parameters).verdict, Verdict::kOk);
}

TEST(DoctorFrames, SuggestsAMountingWhereTfHasNone) {
  DoctorRecording recording = goodRecording();
  recording.transforms.clear();
  std::string line;
  EXPECT_EQ(verdictOf(checkCameraTf(recording, line), "camera_tf"), Verdict::kFault);
  EXPECT_EQ(line, "rosrun tf2_ros static_transform_publisher 0 0 0 -1.5708 0 -1.5708 base cam");
  for (DoctorImage& image : recording.images) image.frame = "ardrone_base_bottomcam";
  checkCameraTf(recording, line);
  EXPECT_EQ(line,
            "rosrun tf2_ros static_transform_publisher 0 -0.02 0 1.5708 0 3.14159 base "
            "ardrone_base_bottomcam");
  recording.images.clear();
  EXPECT_EQ(verdictOf(checkCameraTf(recording, line), "camera_tf"), Verdict::kNotChecked);
}

TEST(DoctorFrames, FindsMountingsThatCannotBe) {
  DoctorRecording far = goodRecording();
  std::string line;
  far.transforms["cam"].T_parent_child.translation() << 0, 0, 210;
  EXPECT_EQ(verdictOf(checkCameraTf(far, line), "camera_tf"), Verdict::kFault);
  far.transforms["cam"].T_parent_child.translation() << 0, 0, 21;
  EXPECT_EQ(verdictOf(checkCameraTf(far, line), "camera_tf"), Verdict::kWarning);
  DoctorRecording unturned = goodRecording();
  unturned.transforms["cam"].T_parent_child.linear().setIdentity();
  EXPECT_EQ(verdictOf(checkCameraTf(unturned, line), "camera_tf"), Verdict::kWarning);
}

TEST(DoctorFrames, TheStaticTransformsLineIsTheTransform) {
  for (int i = 0; i < 100; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = rotationOf(Eigen::Vector3d(std::sin(i), std::cos(3 * i), std::sin(2 * i)) * 2);
    if (i % 5 == 0) T.linear() = rotationOf({0, M_PI / 2 * (i % 2 == 0 ? 1 : -1), 0});
    if (i % 10 == 0) T.linear() *= rotationOf({0.3, 0, 0});
    double x = 0, y = 0, z = 0, yaw = 0, pitch = 0, roll = 0;
    const std::string line = staticTransformLine(T, "a", "b");
    ASSERT_EQ(std::sscanf(line.c_str(),
                          "rosrun tf2_ros static_transform_publisher %lf %lf %lf %lf %lf %lf a b",
                          &x, &y, &z, &yaw, &pitch, &roll),
              6);
    const Eigen::Matrix3d R =
        rotationOf({0, 0, yaw}) * rotationOf({0, pitch, 0}) * rotationOf({roll, 0, 0});
    EXPECT_LT(Eigen::AngleAxisd(R.transpose() * T.linear()).angle(), 1e-4) << line;
  }
}

TEST(DoctorRecording, LooksUpThroughTheTree) {
  DoctorRecording recording = goodRecording();
  recording.transforms["imu"] = {"base", Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1)), {}};
  const auto T_imu_cam = lookUp(recording, "imu", "cam");
  ASSERT_TRUE(T_imu_cam);
  EXPECT_TRUE(T_imu_cam->isApprox(Eigen::Translation3d(0, 0, -1) * forwardCamera()));
  EXPECT_FALSE(lookUp(recording, "base", "nobody"));
  recording.transforms["odom"] = {"cam", Eigen::Isometry3d::Identity(), {}};  // a circle
  EXPECT_FALSE(lookUp(recording, "base", "nobody"));
  EXPECT_TRUE(isInTree(recording, "odom"));
}

}  // namespace
}  // namespace ardrone_vslam
