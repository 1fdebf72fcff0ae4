// SPDX-License-Identifier: BSD-3-Clause
#include "pave_sequence.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "camera_yaml.hpp"
#include "folder_sequence.hpp"
#include "pave_decoder.hpp"

namespace ardrone_vslam {
namespace {

/// The driver's transform base -> front camera.
constexpr double kFrontCameraForward_m = 0.21;

std::vector<std::uint8_t> readBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(path + ": cannot be read; check the path");
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

PaveStream readStream(const std::string& path) {
  const auto bytes = readBytes(path);
  PaveStream stream = parsePave(bytes.data(), bytes.size());
  if (stream.statistics.packets == 0) {
    throw std::runtime_error(path +
                             ": holds no PaVE header; give the raw stream of the drone's video "
                             "port (5555)");
  }
  if (stream.frames.empty()) {
    throw std::runtime_error(path + ": none of its " + std::to_string(stream.statistics.packets) +
                             " packets is a whole H.264 picture that needs no other (IDR); record "
                             "a longer stream");
  }
  return stream;
}

std::vector<std::string> damageOf(const PaveStatistics& statistics) {
  const std::pair<std::size_t, const char*> kinds[] = {
      {statistics.broken_packets, "packets are damaged or of another codec"},
      {statistics.garbage_bytes, "bytes belong to no packet"},
      {statistics.lost_frames, "frames are missing"},
      {statistics.misordered_frames, "frames are repeated or out of order"},
      {statistics.other_size_frames,
       "frames are of another size than most (another camera or setting)"},
      {statistics.waiting_frames, "frames build on a missing one"}};
  std::vector<std::string> damage;
  for (const auto& kind : kinds) {
    if (kind.first > 0) damage.push_back(std::to_string(kind.first) + " " + kind.second);
  }
  return damage;
}

/// The indices of the longest strictly ascending sub-sequence (patience sorting), O(n log n).
std::vector<std::size_t> longestAscent(const std::vector<std::int64_t>& values) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> ends;  // of the ascents of each length: the one that ends lowest
  std::vector<std::size_t> before(values.size(), kNone);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto end = std::lower_bound(
        ends.begin(), ends.end(), values[i],
        [&values](std::size_t index, std::int64_t value) { return values[index] < value; });
    if (end != ends.begin()) before[i] = *std::prev(end);
    if (end == ends.end()) {
      ends.push_back(i);
    } else {
      *end = i;
    }
  }
  std::vector<std::size_t> ascent;
  for (std::size_t i = ends.empty() ? kNone : ends.back(); i != kNone; i = before[i])
    ascent.push_back(i);
  std::reverse(ascent.begin(), ascent.end());
  return ascent;
}

class PaveFile : public PaveSequence {
 public:
  PaveFile(const std::string& path, const PaveOptions& options, PaveStream stream)
      : name_(path),
        warnings_(damageOf(stream.statistics)),
        decoder_(path, std::move(stream.frames)) {
    const std::filesystem::path beside = std::filesystem::path(path).parent_path() / "camera.yaml";
    calibration_ = options.camera_yaml.empty() ? beside.string() : options.camera_yaml;
    camera_ = readCameraYaml(calibration_);
    takeStamps();
    checkImageSize(decoder_.image(0), path, camera_, calibration_);
    if (!options.at_rest) return;
    for (const std::int64_t stamp_ns : stamps_ns_) {
      truth_.append({stamp_ns, Eigen::Isometry3d::Identity()});
    }
  }

  std::string name() const override { return name_; }
  std::size_t size() const override { return stamps_ns_.size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return stamps_ns_.at(index); }
  cv::Mat image(std::size_t index) override {
    cv::Mat image = decoder_.image(frames_.at(index));
    checkImageSize(image, name_ + ", frame " + std::to_string(index), camera_, calibration_);
    return image;
  }
  const CameraIntrinsics& camera() const override { return camera_; }
  Eigen::Isometry3d T_base_cam() const override {
    return Eigen::Translation3d(kFrontCameraForward_m, 0, 0) * forwardCamera();
  }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<ObserverState>& observer() const override { return observer_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  /// As many frames as possible whose stamps ascend: where the clock stands still, goes back or is
  /// damaged, frames are decoded (others build on them) but not handed on.
  void takeStamps() {
    std::vector<std::int64_t> stamps_ns;
    for (std::size_t i = 0; i < decoder_.size(); ++i)
      stamps_ns.push_back(std::int64_t{1'000'000} * decoder_.header(i).timestamp_ms);
    frames_ = longestAscent(stamps_ns);
    for (const std::size_t frame : frames_) stamps_ns_.push_back(stamps_ns[frame]);
    if (decoder_.droppedFrames() > 0) {
      warnings_.push_back(std::to_string(decoder_.droppedFrames()) +
                          " frames are in groups that cannot be decoded whole");
    }
    if (frames_.size() < decoder_.size()) {
      warnings_.push_back(std::to_string(decoder_.size() - frames_.size()) +
                          " frames have a stamp that is not later than the one before");
    }
  }

  std::string name_;
  std::vector<std::string> warnings_;
  PaveDecoder decoder_;
  std::string calibration_;
  CameraIntrinsics camera_;
  std::vector<std::size_t> frames_;  // of the decoder
  std::vector<std::int64_t> stamps_ns_;
  Trajectory truth_;
  std::vector<ObserverState> observer_;  // always empty
};

}  // namespace

std::unique_ptr<PaveSequence> openPave(const std::string& path, const PaveOptions& options) {
  return std::make_unique<PaveFile>(path, options, readStream(path));
}

}  // namespace ardrone_vslam
