// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/tf_buffer.hpp"

namespace ardrone_vslam {
namespace {

/// Frames above `frame`, the nearest first.
std::vector<std::string> ancestorsOf(const tf2::BufferCore& tf, const std::string& frame) {
  constexpr std::size_t kMost = 100;  // tf may have loops
  std::vector<std::string> ancestors;
  std::string parent;
  while (ancestors.size() < kMost &&
         tf._getParent(ancestors.empty() ? frame : ancestors.back(), ros::Time(0), parent))
    ancestors.push_back(parent);
  return ancestors;
}

/// PREFIX when `whole` is PREFIX/`frame`; else empty.
std::string prefixOf(const std::string& whole, const std::string& frame) {
  const std::string tail = "/" + frame;
  if (whole.size() <= tail.size()) return {};
  const std::size_t at = whole.size() - tail.size();
  return whole.compare(at, tail.size(), tail) == 0 ? whole.substr(0, at) : "";
}

}  // namespace

const ros::Duration TfBuffer::kCache(10.0);

void TfBuffer::take(const tf2_msgs::TFMessage& message, const std::string& sender, bool is_static,
                    const ros::Time& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (now < latest_now_) forget();
  latest_now_ = now;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    if (is_static || isNew(transform.child_frame_id, transform.header.stamp))
      buffer_.setTransform(transform, sender, is_static);
  }
}

bool TfBuffer::isNew(const std::string& child_frame, const ros::Time& stamp) {
  const bool has_slash = !child_frame.empty() && child_frame.front() == '/';  // tf2 takes it off
  std::set<ros::Time>& stamps = stamps_[has_slash ? child_frame.substr(1) : child_frame];
  if (!stamps.empty() && stamp + kCache < *stamps.rbegin()) {
    ++too_old_;
    return false;
  }
  if (!stamps.insert(stamp).second) {
    ++repeated_;
    return false;
  }
  while (*stamps.begin() + kCache < *stamps.rbegin()) stamps.erase(stamps.begin());
  return true;
}

void TfBuffer::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  forget();
}

void TfBuffer::forget() {
  buffer_.clear();
  stamps_.clear();
}

std::uint64_t TfBuffer::repeated() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return repeated_;
}

std::uint64_t TfBuffer::tooOld() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return too_old_;
}

std::string odomFrameFault(const tf2::BufferCore& tf, const std::string& map_frame,
                           const std::string& odom_frame, const std::string& base_frame) {
  const std::vector<std::string> above = ancestorsOf(tf, base_frame);
  if (above.empty()) return {};
  for (const std::string& frame : above) {
    if (frame == odom_frame || frame == map_frame) return {};
  }
  const std::string& parent = above.front();
  const std::string prefix = prefixOf(parent, odom_frame);
  const std::string set = "the mapper's odom_frame to " + parent;
  return "the odometry says that " + base_frame + " lies in " + odom_frame +
         ", tf that it lies in " + parent + ", so that " + map_frame + " -> " + odom_frame +
         " hangs beside tf's tree: set " +
         (prefix.empty() ? set : "tf_prefix to " + prefix + ", or " + set);
}

}  // namespace ardrone_vslam
