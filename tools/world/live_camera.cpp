// SPDX-License-Identifier: BSD-3-Clause
#include "world/live_camera.hpp"

#include <chrono>
#include <utility>

namespace ardrone_vslam {

LiveCamera::LiveCamera(const World& world, const CameraEffects& effects,
                       const std::vector<std::string>& camera_names)
    : world_(world) {
  for (const std::string& name : camera_names) {
    lenses_.try_emplace(name, cameraNamed(name).intrinsics, effects);
  }
  thread_ = std::thread([this] { work(); });
}

LiveCamera::~LiveCamera() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LiveCamera::shoot(CameraShot shot) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_) ++counts_.lost;
    waiting_ = std::move(shot);
  }
  changed_.notify_all();
}

std::optional<CameraShot> LiveCamera::take(std::int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (finished_.empty() || finished_.front().stamp_ns > now_ns) return std::nullopt;
  CameraShot shot = std::move(finished_.front());
  finished_.pop_front();
  return shot;
}

LiveCamera::Counts LiveCamera::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

void LiveCamera::work() {
  using Clock = std::chrono::steady_clock;
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || waiting_; });
    if (stop_) return;
    CameraShot shot = std::move(*waiting_);
    waiting_.reset();
    lock.unlock();
    const auto begin = Clock::now();
    shot.image = lenses_.at(shot.camera).shoot(world_.at(shot.t_s), shot.motion, shot.seed);
    const std::chrono::duration<double, std::milli> spent = Clock::now() - begin;
    lock.lock();
    finished_.push_back(std::move(shot));
    ++counts_.rendered;
    counts_.render_ms = spent.count();
  }
}

}  // namespace ardrone_vslam
