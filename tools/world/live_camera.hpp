// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sequences/drone_cameras.hpp"
#include "world/world.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {

/// A picture to be taken, or taken.
struct CameraShot {
  std::int64_t stamp_ns = 0;  ///< when it is to be handed over
  std::string camera;         ///< a name of cameras()
  double t_s = 0;             ///< the world's time
  CameraPath motion;          ///< of that camera about then
  std::uint64_t seed = 0;     ///< of its noise
  cv::Mat image;              ///< 8-bit grey, once it is taken
};

/// A camera that renders in a thread of its own. At most one shot waits for it: a next one takes
/// the waiting one's place, so that a slow machine loses images and none comes late.
class LiveCamera {
 public:
  struct Counts {
    std::uint64_t rendered = 0;
    std::uint64_t lost = 0;  ///< there was no time for them
    double render_ms = 0;    ///< of the latest
  };

  /// @param world  outlives the camera. @throws std::invalid_argument for an unknown camera
  LiveCamera(const World& world, const CameraEffects& effects,
             const std::vector<std::string>& camera_names);
  ~LiveCamera();

  /// Does not wait.
  void shoot(CameraShot shot);
  /// The oldest finished one, once its stamp has come.
  std::optional<CameraShot> take(std::int64_t now_ns);
  Counts counts() const;

 private:
  void work();

  const World& world_;
  std::map<std::string, WorldCamera> lenses_;
  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::optional<CameraShot> waiting_;
  std::deque<CameraShot> finished_;
  Counts counts_;
  bool stop_ = false;
  std::thread thread_;  // the last one: it uses all others
};

}  // namespace ardrone_vslam
