// SPDX-License-Identifier: BSD-3-Clause
// flight_poses FLIGHT [mark_stages] [NAME=VALUE...]: tracker, set-up watch and Slam over a packed
// flight (pack_flight), a line for each image on standard output: stamp, fused pose, state,
// features, landmarks. Nothing but the core, so that it runs cross-compiled; the parameters are
// those of docs/parameters.md. With mark_stages the emulator's plugin (benchmark/drone) is told the
// stages.
#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "ardrone_vslam/setup_monitor.hpp"
#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "ardrone_vslam/tracker.hpp"

namespace {

using namespace ardrone_vslam;

/// After the core's own, and idleness: the set-up watch, which programs call between two of them.
constexpr auto kSetup = static_cast<Stage>(kStageCount + 1);

/// Sets the parameter of this name, if it is one of those visited.
struct Setter {
  std::string name;
  std::string text;
  bool found = false;

  template <class T>
  void operator()(const ParameterInfo& info, T& value) {
    if (name != info.name) return;
    found = true;
    if constexpr (std::is_enum_v<T>) {
      for (std::size_t i = 0; i < EnumNames<T>::kNames.size(); ++i) {
        if (text == EnumNames<T>::kNames[i]) value = static_cast<T>(i);
      }
      if (text != nameOf(value)) throw std::runtime_error(name + ": no such choice: " + text);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = text == "true";
    } else if constexpr (std::is_same_v<T, NumberOrAuto>) {
      if (text != kAuto) value = std::strtod(text.c_str(), nullptr);
    } else {
      value = static_cast<T>(std::strtod(text.c_str(), nullptr));
    }
  }
};

void set(const std::string& assignment, TrackerConfig& tracker, SlamConfig& slam) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw std::runtime_error(assignment + ": must be NAME=VALUE");
  Setter setter{assignment.substr(0, equals), assignment.substr(equals + 1)};
  visitParameters(tracker, setter);
  visitParameters(slam, setter);
  if (!setter.found) throw std::runtime_error(setter.name + ": no such parameter");
}

/// A packed flight: a line `camera`, then lines `odometry` and lines `image`, each
/// of these with its bytes.
class Flight {
 public:
  explicit Flight(const char* path) : file_(std::fopen(path, "rb"), &std::fclose) {
    if (!file_) throw std::runtime_error(std::string(path) + ": cannot be read");
    CameraIntrinsics& c = camera_;
    if (std::fscanf(file_.get(), "camera %d %d %lf %lf %lf %lf %lf %lf %lf %lf %lf", &c.width_px,
                    &c.height_px, &c.fx_px, &c.fy_px, &c.cx_px, &c.cy_px, &c.k1, &c.k2, &c.p1,
                    &c.p2, &c.k3) != 11 ||
        std::fgetc(file_.get()) != '\n') {
      throw std::runtime_error(std::string(path) + ": is no packed flight");
    }
    pixels_.resize(static_cast<std::size_t>(c.width_px) * static_cast<std::size_t>(c.height_px));
  }

  const CameraIntrinsics& camera() const { return camera_; }

  /// @return the stamp of the next image, negative at the end; the odometry before it goes into
  /// the buffer
  std::int64_t next(OdometryBuffer& buffer) {
    char kind[16];
    OdometryState state;
    while (std::fscanf(file_.get(), "%15s %" SCNd64, kind, &state.stamp_ns) == 2) {
      if (std::strcmp(kind, "image") == 0) {
        if (std::fgetc(file_.get()) != '\n' ||
            std::fread(pixels_.data(), 1, pixels_.size(), file_.get()) != pixels_.size()) {
          throw std::runtime_error("the flight is cut off within an image");
        }
        return state.stamp_ns;
      }
      Eigen::Vector3d p;
      Eigen::Quaterniond q;
      if (std::fscanf(file_.get(), "%lf %lf %lf %lf %lf %lf %lf", &p.x(), &p.y(), &p.z(), &q.x(),
                      &q.y(), &q.z(), &q.w()) != 7) {
        throw std::runtime_error("the flight is damaged");
      }
      state.T_odom_base = Eigen::Translation3d(p) * q.normalized();
      buffer.push(state);
    }
    if (!std::feof(file_.get())) throw std::runtime_error("the flight is damaged");
    return -1;
  }

  ImageView image() const {
    return {pixels_.data(), camera_.width_px, camera_.height_px, camera_.width_px};
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  CameraIntrinsics camera_;
  std::vector<std::uint8_t> pixels_;
};

void run(int argc, char** argv) {
  if (argc < 2)
    throw std::runtime_error("usage: flight_poses FLIGHT [mark_stages] [NAME=VALUE...]");
  TrackerConfig tracker_config;
  SlamConfig slam_config;
  StageHook hook;
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "mark_stages") == 0) {
      hook = [](Stage stage) { close(-1000 - static_cast<int>(stage)); };  // no such file
    } else {
      set(argv[i], tracker_config, slam_config);
    }
  }

  Flight flight(argv[1]);
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();  // base looks along its x
  T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Tracker tracker(tracker_config, flight.camera());
  SetupMonitor setup(slam_config.image_time_offset_s);
  setup.useCamera(T_base_cam);
  Slam slam(slam_config, T_base_cam);
  ImageFeatures features;
  OdometryBuffer buffer(slam_config.odometry);
  OdometryState state;
  for (std::int64_t stamp_ns; (stamp_ns = flight.next(buffer)) >= 0;) {
    if (buffer.at(setup.clock().exposed_ns(stamp_ns), state) != OdometryBuffer::Lookup::kFound)
      continue;
    state.stamp_ns = stamp_ns;
    tracker.process(flight.image(), stamp_ns, features, hook);
    if (hook) hook(kSetup);
    setup.see(features, buffer, slam);
    const FrameResult& result = slam.process(features, state, hook);
    const Eigen::Vector3d p = result.T_map_base.translation();
    const Eigen::Quaterniond q(result.T_map_base.linear());
    std::printf("%" PRId64 " %.17g %.17g %.17g %.17g %.17g %.17g %.17g %s %d %d\n", result.stamp_ns,
                p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(),
                kSlamStateNames[static_cast<std::size_t>(result.state)], result.features,
                result.landmarks);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "flight_poses: %s\n", e.what());
    return 1;
  }
  return 0;
}
