// SPDX-License-Identifier: BSD-3-Clause
// Each fault of the driver, through bag, configuration and filter: the error of the fused pose
// stays what it is without. The driver's messages are those of its emulation; what the cameras see
// is a PointWorld, so that nothing need be rendered.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bags/bag_sequence.hpp"
#include "driver/driver_link.hpp"
#include "driver/emulation/driver_bag.hpp"
#include "landmarks/point_world.hpp"
#include "run/offline_run.hpp"
#include "support/sequence_folders.hpp"
#include "support/shipped_profiles.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDuration_s = 50;  // nearly three laps
constexpr double kRate_hz = 10;     // of the images
constexpr double kVideoDelay_s = 0.0875;
constexpr std::uint64_t kSeeds = 3;

const WorldSequence& flight(std::uint64_t seed) {
  static std::map<std::uint64_t, WorldSequence> flights;
  WorldOptions options;
  options.duration_s = kDuration_s;
  options.rate_hz = 0.2;  // the bag's own images are not looked at
  options.seed = seed;
  return flights.try_emplace(seed, options).first->second;
}

PointWorld points(const World::Extent& extent, std::uint64_t seed) {
  PointWorld points(seed);
  points.addRoom(extent.size_m, 1500);
  RandomSource random(seed, 5);
  for (int i = 0; i < 4000; ++i) {
    points.addPoint({extent.size_m.x() * random.uniform(-0.5, 0.5),
                     extent.size_m.y() * random.uniform(-0.5, 0.5), 0});
  }
  const Eigen::Vector3d floor_m(extent.middle_m.x(), extent.middle_m.y(),
                                extent.middle_m.z() - extent.size_m.z() / 2);
  points.transform(Eigen::Isometry3d(Eigen::Translation3d(floor_m)));
  return points;
}

/// What the front camera's lens shows of such features, looked up in the bag's calibration.
void lookUp(const CameraModel& calibration, ImageFeatures& features) {
  static const CameraModel lens(cameraNamed("front").intrinsics);
  for (Eigen::Vector3f& ray_cam : features.bearing_cam) {
    const auto pixel_px = lens.project(ray_cam.cast<double>());
    const auto found_cam = pixel_px ? calibration.bearing(*pixel_px) : std::nullopt;
    ASSERT_TRUE(found_cam);
    ray_cam = found_cam->cast<float>();
  }
  features.focal_length_px = static_cast<float>(calibration.focalLength_px());
}

/// Images that the driver stamps as late as the faults have it, through the filter that
/// config/ardrone.yaml sets up.
RunResult fly(const WorldSequence& flown, const BagSequence& bag, const DriverFaults& faults,
              std::uint64_t seed) {
  const bool is_late = faults.count(DriverFault::kBursts) > 0;
  PipelineConfig config =
      loadConfig(test::packageFile("config/ardrone.yaml"),
                 {"mapper/image_time_offset_s=" + std::to_string(is_late ? -kVideoDelay_s : 0)});
  PointWorld seen = points(flown.world().extent(), seed);
  DriverLink link(!is_late, seed);
  const CameraModel calibration(bag.camera());
  const CameraChoice* camera = &cameraNamed("front");
  BackEnd back_end(config.mapper, camera->T_body_cam, bag.odometry(), bag.ranges());
  for (int i = 0; i < kDuration_s * kRate_hz; ++i) {
    const double t_s = i / kRate_hz;
    const bool is_middle = t_s >= kDuration_s / 3 && t_s < kDuration_s * 2 / 3;
    const bool is_bottom = is_middle && faults.count(DriverFault::kTogglecam) > 0;
    const CameraChoice* now = &cameraNamed(is_bottom ? "bottom" : "front");
    TrackedFrame frame;
    if (now != camera) {
      seen.changeCamera();
      frame.other_camera = now->T_body_cam;
    }
    camera = now;
    const std::int64_t stamp_ns = kDriverBagBegin_ns + std::llround(t_s * 1e9);
    frame.features =
        seen.look(flown.flight().pose(t_s) * camera->T_body_cam, stamp_ns + link.videoDelay_ns());
    if (!is_bottom) lookUp(calibration, frame.features);
    back_end.process(frame);
  }
  return back_end.result();
}

/// Of the positions, with the first pose as the truth's: x and y of odom begin at the drone.
double rmse_m(const WorldSequence& flown, const RunResult& run, bool is_late) {
  const auto truthAt = [&](std::int64_t stamp_ns) {
    const double t_s = static_cast<double>(stamp_ns - kDriverBagBegin_ns) * 1e-9;
    return flown.flight().pose(t_s - (is_late ? kVideoDelay_s : 0));
  };
  const auto& frames = run.frames;
  const Eigen::Isometry3d T_map_world =
      frames.front().result.T_map_base * truthAt(frames.front().result.stamp_ns).inverse();
  double sum_m2 = 0;
  for (const RunFrame& frame : frames) {
    const Eigen::Isometry3d truth = T_map_world * truthAt(frame.result.stamp_ns);
    sum_m2 += (frame.result.T_map_base.translation() - truth.translation()).squaredNorm();
  }
  return std::sqrt(sum_m2 / static_cast<double>(frames.size()));
}

/// Median of the seeds.
double errorWith_m(const DriverFaults& faults) {
  std::vector<double> errors_m;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const TemporaryFolder folder;
    const WorldSequence& flown = flight(seed);
    DriverBagOptions options;
    options.faults = faults;
    options.profile = test::shippedProfile("drone");
    options.tool = "test";
    writeDriverBag(flown, options, folder.file("driver.bag"));
    BagReadOptions read;
    read.image_topic = "/ardrone/front/image_raw";
    read.use_navdata_height = true;
    read.rescale_calibration = true;
    const auto bag = openBag(folder.file("driver.bag"), read);
    const RunResult run = fly(flown, *bag, faults, seed);
    EXPECT_GE(run.frames.size(), kDuration_s * kRate_hz - 2);
    errors_m.push_back(rmse_m(flown, run, faults.count(DriverFault::kBursts) > 0));
  }
  std::sort(errors_m.begin(), errors_m.end());
  return errors_m[kSeeds / 2];
}

TEST(DriverFaultError, IsThatOfTheCleanFlight) {
  const double clean_m = errorWith_m({});
  EXPECT_LT(clean_m, 0.147);  // measured: 0.116, 0.04 to 0.16 in 20 seeds; the odometry's 0.5 to 2
  // unprefixed_frame changes no number.
  for (const char* name :
       {"mirrored_yaw", "epoch_dt", "zero_covariance", "fused_altitude", "whole_metres", "bursts",
        "unscaled_camera_info", "togglecam", "released", "all"}) {
    // What the README says. Measured: 0.86 to 1.22, the last with "all".
    EXPECT_LT(errorWith_m(driverFaultsNamed({name})), 1.35 * clean_m) << name;
  }
}

}  // namespace
}  // namespace ardrone_vslam
