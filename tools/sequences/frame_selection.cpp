// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "sequences/sequence_view.hpp"

namespace ardrone_vslam {
namespace {

/// Recorded states and ranges this long before the first and after the last image stay, so that the
/// stamps of images (and of late states) are covered.
constexpr std::int64_t kOdometryMargin_ns = 1'000'000'000;

std::optional<std::size_t> parsePart(const std::string& part, const std::string& text) {
  if (part.empty()) return std::nullopt;
  std::size_t value = 0;
  const auto result = std::from_chars(part.data(), part.data() + part.size(), value);
  if (result.ec != std::errc() || result.ptr != part.data() + part.size()) {
    throw std::invalid_argument("frames '" + text + "': '" + part +
                                "' is not a whole number from 0; write A:B:STEP, for example "
                                "0:100:2 or 50: or ::2");
  }
  return value;
}

/// @return frames 0, 2, 4 .. of `frames`, then the odd ones backward
std::vector<std::size_t> pingPong(const std::vector<std::size_t>& frames) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < frames.size(); i += 2) order.push_back(frames[i]);
  for (std::size_t i = frames.size() - frames.size() % 2; i >= 2; i -= 2) {
    order.push_back(frames[i - 1]);
  }
  return order;
}

std::int64_t medianInterval_ns(const Sequence& sequence, const std::vector<std::size_t>& frames) {
  std::vector<std::int64_t> intervals_ns;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    intervals_ns.push_back(sequence.stamp_ns(frames[i]) - sequence.stamp_ns(frames[i - 1]));
  }
  const auto middle = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
  std::nth_element(intervals_ns.begin(), middle, intervals_ns.end());
  return *middle;
}

/// The part of the truth that the images cover, from the very first to the very last image: a
/// simulated odometry starts without error where the images start.
Trajectory cut(const Trajectory& truth, std::int64_t first_ns, std::int64_t last_ns) {
  if (truth.empty() || truth.poses().back().stamp_ns < first_ns ||
      truth.poses().front().stamp_ns > last_ns) {
    return {};
  }
  Trajectory result;
  if (truth.poses().front().stamp_ns < first_ns) result.append({first_ns, truth.at(first_ns)});
  for (const StampedPose& pose : truth.poses()) {
    const bool is_later = result.empty() || pose.stamp_ns > result.poses().back().stamp_ns;
    if (pose.stamp_ns >= first_ns && pose.stamp_ns <= last_ns && is_later) result.append(pose);
  }
  if (truth.poses().back().stamp_ns > last_ns &&
      (result.empty() || result.poses().back().stamp_ns < last_ns)) {
    result.append({last_ns, truth.at(last_ns)});
  }
  return result;
}

class SelectedSequence : public SequenceView {
 public:
  SelectedSequence(std::unique_ptr<Sequence> sequence, const std::vector<std::size_t>& frames,
                   bool ping_pong)
      : SequenceView(std::move(sequence)),
        order_(ping_pong ? pingPong(frames) : frames),
        camera_(cameraAt(cameraOf(0))) {
    if (ping_pong) {
      restamp(frames);
    } else {
      keepStamps();
    }
  }

  std::size_t size() const override { return order_.size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return stamps_ns_.at(index); }
  cv::Mat image(std::size_t index) override { return sequence().image(order_.at(index)); }
  const CameraIntrinsics& camera() const override { return camera_.intrinsics; }
  Eigen::Isometry3d T_base_cam() const override { return camera_.T_base_cam; }
  std::size_t cameraOf(std::size_t index) const override {
    return sequence().cameraOf(order_.at(index));
  }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<OdometryState>& odometry() const override { return odometry_; }
  std::vector<RangeReading> ranges() const override { return ranges_; }

 private:
  void restamp(const std::vector<std::size_t>& frames) {
    const std::int64_t start_ns = sequence().stamp_ns(frames.front());
    const std::int64_t interval_ns = medianInterval_ns(sequence(), frames);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      stamps_ns_.push_back(start_ns + static_cast<std::int64_t>(i) * interval_ns);
      if (!sequence().truth().empty()) {
        truth_.append({stamps_ns_.back(), sequence().truth().at(sequence().stamp_ns(order_[i]))});
      }
    }
  }

  void keepStamps() {
    for (const std::size_t frame : order_) stamps_ns_.push_back(sequence().stamp_ns(frame));
    truth_ = cut(sequence().truth(), stamps_ns_.front(), stamps_ns_.back());
    const auto isCovered = [this](std::int64_t stamp_ns) {
      return stamp_ns >= stamps_ns_.front() - kOdometryMargin_ns &&
             stamp_ns <= stamps_ns_.back() + kOdometryMargin_ns;
    };
    for (const OdometryState& state : sequence().odometry()) {
      if (isCovered(state.stamp_ns)) odometry_.push_back(state);
    }
    for (const RangeReading& reading : sequence().ranges()) {
      if (isCovered(reading.stamp_ns)) ranges_.push_back(reading);
    }
  }

  std::vector<std::size_t> order_;  // frames of the whole sequence
  SequenceCamera camera_;           // of the first image
  std::vector<std::int64_t> stamps_ns_;
  Trajectory truth_;
  std::vector<OdometryState> odometry_;
  std::vector<RangeReading> ranges_;
};

}  // namespace

FrameSelection FrameSelection::parse(const std::string& text, bool ping_pong) {
  FrameSelection selection;
  selection.ping_pong = ping_pong;
  if (text.empty()) return selection;
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (parts.size() < 2 || parts.size() > 3) {
    throw std::invalid_argument("frames '" + text +
                                "' must be A:B:STEP with one or two colons, for example 0:100:2 "
                                "or 50: or ::2");
  }
  parts.resize(3);
  selection.begin = parsePart(parts[0], text).value_or(0);
  selection.end = parsePart(parts[1], text);
  selection.step = parsePart(parts[2], text).value_or(1);
  if (selection.step == 0) {
    throw std::invalid_argument("frames '" + text + "': the step must be at least 1");
  }
  if (selection.end && *selection.end <= selection.begin) {
    throw std::invalid_argument("frames '" + text +
                                "': the end B must be larger than the begin A (frame B itself is "
                                "left out)");
  }
  return selection;
}

std::unique_ptr<Sequence> select(std::unique_ptr<Sequence> sequence,
                                 const FrameSelection& selection) {
  const std::size_t end = std::min(selection.end.value_or(sequence->size()), sequence->size());
  std::vector<std::size_t> frames;
  for (std::size_t i = selection.begin; i < end; i += selection.step) {
    frames.push_back(i);
    if (selection.step > end - i) break;
  }
  if (frames.empty()) {
    throw std::runtime_error(sequence->name() + ": has " + std::to_string(sequence->size()) +
                             " frames, the selection begins at frame " +
                             std::to_string(selection.begin) + "; choose frames within it");
  }
  if (selection.ping_pong && frames.size() < 2) {
    throw std::runtime_error(sequence->name() +
                             ": ping-pong needs at least two selected frames; select more");
  }
  return std::make_unique<SelectedSequence>(std::move(sequence), frames, selection.ping_pong);
}

}  // namespace ardrone_vslam
