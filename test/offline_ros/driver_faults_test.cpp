// SPDX-License-Identifier: BSD-3-Clause
// Each fault of the driver shows in a bag, and nothing else changes by it.
#include "driver/driver_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "driver_recording.hpp"

namespace ardrone_vslam {
namespace {

using Names = std::set<std::string>;

const DriverRecording& clean() {
  static const DriverRecording recording({});
  return recording;
}

/// Topics whose messages differ.
Names changedTopics(const DriverRecording& a, const DriverRecording& b) {
  Names topics, changed;
  for (const auto& type : a.types()) topics.insert(type.first);
  for (const auto& type : b.types()) topics.insert(type.first);
  topics.erase("/make_bag/info");
  for (const std::string& topic : topics) {
    if (a.raw(topic) != b.raw(topic)) changed.insert(topic);
  }
  return changed;
}

/// Parts of the odometry's messages that differ.
Names changedParts(const DriverRecording& a, const DriverRecording& b) {
  Names changed;
  const auto before = a.odometry(), after = b.odometry();
  EXPECT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    const auto note = [&changed](const std::string& part, bool differs) {
      if (differs) changed.insert(part);
    };
    const auto &x = before[i], &y = after[i];
    const auto &p = x.pose.pose.position, &q = y.pose.pose.position;
    note("stamp", x.header.stamp != y.header.stamp);
    note("frame_id", x.header.frame_id != y.header.frame_id);
    note("child_frame_id", x.child_frame_id != y.child_frame_id);
    note("xy", p.x != q.x || p.y != q.y);
    note("z", p.z != q.z);
    note("orientation", x.pose.pose.orientation != y.pose.pose.orientation);
    note("linear", x.twist.twist.linear != y.twist.twist.linear);
    note("angular", x.twist.twist.angular != y.twist.twist.angular);
    note("covariance", x.pose.covariance != y.pose.covariance);
    note("covariance", x.twist.covariance != y.twist.covariance);
  }
  return changed;
}

const Names kOdometryAndTf{"/ardrone/odometry", "/tf"};

TEST(DriverFaults, MirroredYaw) {
  const DriverRecording faulty({DriverFault::kMirroredYaw});
  EXPECT_EQ(changedTopics(clean(), faulty), kOdometryAndTf);
  EXPECT_EQ(changedParts(clean(), faulty), Names{"xy"});
}

TEST(DriverFaults, EpochDt) {
  const DriverRecording faulty({DriverFault::kEpochDt});
  EXPECT_EQ(changedTopics(clean(), faulty), kOdometryAndTf);
  EXPECT_EQ(changedParts(clean(), faulty), (Names{"xy", "z"}));
  const auto before = clean().odometry(), after = faulty.odometry();
  const std::size_t restart = after.size() / 2;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const double far_m = positionOf(after[i].pose.pose).head<2>().norm();
    if (i < restart) {
      EXPECT_EQ(after[i].pose.pose, before[i].pose.pose);
    } else {
      EXPECT_GT(far_m, 1e6);
    }
  }
  EXPECT_NEAR(
      positionOf(after[restart].pose.pose).head<2>().norm(),
      1.4e9 * (rotationOf(after[restart].pose.pose) * velocityOf(after[restart])).head<2>().norm(),
      1e3);
}

TEST(DriverFaults, ZeroCovariance) {
  const DriverRecording faulty({DriverFault::kZeroCovariance});
  EXPECT_EQ(changedTopics(clean(), faulty), Names{"/ardrone/odometry"});
  EXPECT_EQ(changedParts(clean(), faulty), (Names{"angular", "covariance"}));
  for (const auto& message : clean().odometry()) {
    for (std::size_t i = 0; i < 36; i += 7) EXPECT_GT(message.pose.covariance[i], 0);
  }
}

TEST(DriverFaults, FusedAltitude) {
  const DriverRecording faulty({DriverFault::kFusedAltitude});
  EXPECT_EQ(changedTopics(clean(), faulty), kOdometryAndTf);
  EXPECT_EQ(changedParts(clean(), faulty), Names{"z"});
  const auto navdata = faulty.read<Navdata>("/ardrone/navdata");
  const auto odometry = faulty.odometry();
  const auto truth = faulty.read<geometry_msgs::PoseStamped>("/truth/pose");
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    EXPECT_EQ(odometry[i].pose.pose.position.z, navdata[i].altd / 1000.0);
    EXPECT_NEAR(odometry[i].pose.pose.position.z, truth[i].pose.position.z, 0.05);
  }
}

TEST(DriverFaults, WholeMetres) {
  const DriverRecording faulty({DriverFault::kWholeMetres});
  EXPECT_EQ(changedTopics(clean(), faulty), kOdometryAndTf);
  EXPECT_EQ(changedParts(clean(), faulty), Names{"z"});
  for (const auto& message : faulty.odometry()) {
    const double z_m = message.pose.pose.position.z;
    EXPECT_EQ(z_m, std::trunc(z_m));
  }
}

TEST(DriverFaults, UnprefixedFrame) {
  const DriverRecording prefixed({}, "drone", "front", "drone1");
  const DriverRecording faulty({DriverFault::kUnprefixedFrame}, "drone", "front", "drone1");
  EXPECT_EQ(changedTopics(prefixed, faulty), Names{"/ardrone/odometry"});
  EXPECT_EQ(changedParts(prefixed, faulty), Names{"frame_id"});
  EXPECT_EQ(faulty.odometry()[0].header.frame_id, "odom");
}

TEST(DriverFaults, Bursts) {
  const DriverRecording faulty({DriverFault::kBursts});
  const Names unchanged{"/make_bag/info", "/truth/pose"};
  for (const auto& type : clean().types()) {
    EXPECT_EQ(changedTopics(clean(), faulty).count(type.first), 1 - unchanged.count(type.first))
        << type.first;
  }
  EXPECT_EQ(changedParts(clean(), faulty), (Names{"stamp", "xy", "z"}));
  EXPECT_TRUE(faulty.isRecordedAtItsStamps());
  const auto stamps_ns = faulty.stamps_ns("/ardrone/odometry");
  std::size_t sixes = 0;
  for (std::size_t i = 0; i < stamps_ns.size();) {
    const auto run =
        static_cast<std::size_t>(std::count(stamps_ns.begin(), stamps_ns.end(), stamps_ns[i]));
    const bool is_last = i + run == stamps_ns.size();
    EXPECT_TRUE(run == 1 || run == 6 || is_last);
    if (i > 0) {
      EXPECT_EQ(stamps_ns[i] - stamps_ns[i - 1], static_cast<std::int64_t>(run) * 5'000'000);
    }
    sixes += run == 6 ? 1 : 0;
    i += run;
  }
  EXPECT_GT(sixes, 10U);
  const auto on_time_ns = clean().stamps_ns("/ardrone/image_raw");
  const auto late_ns = faulty.stamps_ns("/ardrone/image_raw");
  ASSERT_EQ(late_ns.size(), on_time_ns.size());
  for (std::size_t i = 0; i < late_ns.size(); ++i) {
    EXPECT_GE(late_ns[i] - on_time_ns[i], 75'000'000);
    EXPECT_LE(late_ns[i] - on_time_ns[i], 100'000'000);
  }
  const auto images = faulty.read<sensor_msgs::Image>("/ardrone/image_raw");
  const auto same = clean().read<sensor_msgs::Image>("/ardrone/image_raw");
  for (std::size_t i = 0; i < images.size(); ++i) EXPECT_EQ(images[i].data, same[i].data);
}

TEST(DriverFaults, UnscaledCameraInfo) {
  const DriverRecording faulty({DriverFault::kUnscaledCameraInfo});
  EXPECT_EQ(changedTopics(clean(), faulty),
            (Names{"/ardrone/camera_info", "/ardrone/front/camera_info"}));
  const auto info = faulty.read<sensor_msgs::CameraInfo>("/ardrone/camera_info").front();
  EXPECT_EQ(info.width, 640U);
  EXPECT_NEAR(info.K[0], 2 * 570, 1e-9);
}

TEST(DriverFaults, Togglecam) {
  const DriverRecording faulty({DriverFault::kTogglecam});
  EXPECT_EQ(changedTopics(clean(), faulty),
            (Names{"/ardrone/camera_info", "/ardrone/image_raw", "/ardrone/front/camera_info",
                   "/ardrone/front/image_raw", "/ardrone/bottom/camera_info",
                   "/ardrone/bottom/image_raw"}));
  const std::vector<std::string> wanted{"ardrone_base_frontcam",  "ardrone_base_frontcam",
                                        "ardrone_base_bottomcam", "ardrone_base_bottomcam",
                                        "ardrone_base_frontcam",  "ardrone_base_frontcam"};
  std::vector<std::string> frames;
  for (const auto& image : faulty.read<sensor_msgs::Image>("/ardrone/image_raw")) {
    frames.push_back(image.header.frame_id);
  }
  EXPECT_EQ(frames, wanted);
  EXPECT_EQ(faulty.stamps_ns("/ardrone/front/image_raw").size(), 4U);
  EXPECT_EQ(faulty.stamps_ns("/ardrone/bottom/camera_info").size(), 2U);
}

TEST(DriverFaults, NamesAllReleasedAndUnknown) {
  EXPECT_EQ(driverFaultsNamed({"all"}).size(), driverFaults().size());
  EXPECT_EQ(nameList(driverFaultsNamed({"released"})),
            "mirrored_yaw, zero_covariance, fused_altitude, bursts");
  EXPECT_EQ(nameList({}), "none");
  EXPECT_THROW(driverFaultsNamed({"bursts", "burst"}), std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
