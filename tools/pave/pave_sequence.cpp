// SPDX-License-Identifier: BSD-3-Clause
#include "pave/pave_sequence.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "files/regular_file.hpp"
#include "folders/camera_yaml.hpp"
#include "folders/folder_sequence.hpp"
#include "pave/pave_decoder.hpp"
#include "pave/pave_stamps.hpp"
#include "sequences/drone_cameras.hpp"

namespace ardrone_vslam {
namespace {

std::vector<std::uint8_t> readBytes(const std::string& path) {
  std::ifstream file = openFile(path, kLargestStream_bytes);
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
       "frames are of a size that hardly any other has (a damaged header)"},
      {statistics.waiting_frames, "frames build on a missing one"}};
  std::vector<std::string> damage;
  for (const auto& kind : kinds) {
    if (kind.first > 0) damage.push_back(std::to_string(kind.first) + " " + kind.second);
  }
  return damage;
}

using Size = std::pair<int, int>;  // width and height

std::string nameOf(const Size& size) {
  return std::to_string(size.first) + "x" + std::to_string(size.second);
}

/// The same picture with more or fewer pixels: 720p and 360p of the front camera.
CameraIntrinsics scaledTo(CameraIntrinsics camera, const Size& size) {
  const double x = static_cast<double>(size.first) / camera.width_px;
  const double y = static_cast<double>(size.second) / camera.height_px;
  camera.fx_px *= x;
  camera.fy_px *= y;
  // The middle of the first pixel is 0, its corner -0.5.
  camera.cx_px = (camera.cx_px + 0.5) * x - 0.5;
  camera.cy_px = (camera.cy_px + 0.5) * y - 0.5;
  camera.width_px = size.first;
  camera.height_px = size.second;
  return camera;
}

/// Finds each size's camera.
class PaveCameras {
 public:
  PaveCameras(const std::string& front_yaml, const std::string& bottom_yaml)
      : front_{readCameraYaml(front_yaml), cameraNamed("front").T_body_cam} {
    if (!bottom_yaml.empty()) {
      bottom_ = SequenceCamera{readCameraYaml(bottom_yaml), cameraNamed("bottom").T_body_cam};
      if (fitsFront({bottom_->intrinsics.width_px, bottom_->intrinsics.height_px})) {
        throw std::runtime_error(bottom_yaml + ": is for pictures of the front camera's size (" +
                                 front_yaml +
                                 "), and a stream does not tell the two apart; leave " +
                                 "it out, and choose one camera's pictures by --frames");
      }
    }
  }

  bool fits(const Size& size) const {
    return isOf(front_, size) || (bottom_ && isOf(*bottom_, size));
  }
  /// @return nothing without a calibration
  std::optional<SequenceCamera> find(const Size& size) const {
    if (isOf(front_, size)) return front_;
    if (bottom_ && isOf(*bottom_, size)) return bottom_;
    const CameraIntrinsics& front = front_.intrinsics;
    if (size.first * front.height_px != size.second * front.width_px) return std::nullopt;
    return SequenceCamera{scaledTo(front, size), front_.T_base_cam};
  }
  const CameraIntrinsics& front() const { return front_.intrinsics; }

 private:
  bool fitsFront(const Size& size) const { return isOf(front_, size); }
  static bool isOf(const SequenceCamera& camera, const Size& size) {
    return Size(camera.intrinsics.width_px, camera.intrinsics.height_px) == size;
  }
  SequenceCamera front_;
  std::optional<SequenceCamera> bottom_;
};

class PaveFile : public PaveSequence {
 public:
  PaveFile(const std::string& path, const PaveOptions& options, PaveStream stream)
      : name_(path),
        warnings_(damageOf(stream.statistics)),
        decoder_(path, std::move(stream.frames)) {
    const std::filesystem::path beside = std::filesystem::path(path).parent_path() / "camera.yaml";
    const std::string yaml = options.camera_yaml.empty() ? beside.string() : options.camera_yaml;
    takeCameras(PaveCameras(yaml, options.bottom_camera_yaml), yaml);
    takeStamps();
    if (!options.at_rest) return;
    for (const std::int64_t stamp_ns : stamps_.stamps_ns) {
      truth_.append({stamp_ns, Eigen::Isometry3d::Identity()});
    }
  }

  std::string name() const override { return name_; }
  std::size_t size() const override { return stamps_.stamps_ns.size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return stamps_.stamps_ns.at(index); }
  cv::Mat image(std::size_t index) override {
    cv::Mat image = decoder_.image(stamps_.frames.at(index));
    checkImageSize(image, name_ + ", frame " + std::to_string(index),
                   cameraAt(cameraOf(index)).intrinsics, "its header");
    return image;
  }
  const CameraIntrinsics& camera() const override { return cameras_.at(cameraOf(0)).intrinsics; }
  Eigen::Isometry3d T_base_cam() const override { return cameras_.at(cameraOf(0)).T_base_cam; }
  std::size_t cameraOf(std::size_t index) const override {
    return which_.at(sizeOf(decoder_.header(stamps_.frames.at(index))));
  }
  SequenceCamera cameraAt(std::size_t which) const override { return cameras_.at(which); }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<OdometryState>& odometry() const override { return odometry_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  static Size sizeOf(const PaveHeader& header) { return {header.width_px, header.height_px}; }

  /// A camera for each size that has a calibration.
  void takeCameras(const PaveCameras& known, const std::string& yaml) {
    std::map<Size, std::size_t> counts;
    for (std::size_t i = 0; i < decoder_.size(); ++i) ++counts[sizeOf(decoder_.header(i))];
    const bool any_fits = std::any_of(counts.begin(), counts.end(),
                                      [&](const auto& size) { return known.fits(size.first); });
    if (!any_fits) {
      throw std::runtime_error(name_ + ": its pictures are " + nameOf(sizeOf(decoder_.header(0))) +
                               ", the calibration " + yaml + " is for " +
                               nameOf({known.front().width_px, known.front().height_px}) +
                               "; give the calibration of this camera at this size");
    }
    for (std::size_t i = 0; i < decoder_.size(); ++i) {
      const Size size = sizeOf(decoder_.header(i));
      const auto camera = known.find(size);
      if (which_.count(size) > 0 || !camera) continue;
      which_[size] = cameras_.size();
      cameras_.push_back(*camera);
      if (!known.fits(size)) {
        warnings_.push_back(std::to_string(counts[size]) + " frames are " + nameOf(size) +
                            ": taken for the front camera's, its calibration scaled");
      }
    }
    for (const auto& size : counts) {
      if (which_.count(size.first) > 0) continue;
      warnings_.push_back(std::to_string(size.second) + " frames are " + nameOf(size.first) +
                          ", of another camera without calibration (--bottom-camera), and are "
                          "left out");
    }
  }

  void takeStamps() {
    std::vector<PaveHeader> headers;
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < decoder_.size(); ++i) {
      if (which_.count(sizeOf(decoder_.header(i))) == 0) continue;
      headers.push_back(decoder_.header(i));
      known.push_back(i);
    }
    stamps_ = stampsOf(headers);
    for (std::size_t& frame : stamps_.frames) frame = known[frame];
    const std::pair<std::size_t, const char*> kinds[] = {
        {decoder_.droppedFrames(), "frames are in groups that cannot be decoded whole"},
        {stamps_.dropped_frames, "frames have a stamp that is not later than the one before"},
        {stamps_.restarts,
         "times the drone was restarted: its clock began anew, the stamps go on a second later"},
        {stamps_.spread_frames,
         "frames are of a clock that stands still: they are spread at a constant rate"}};
    for (const auto& kind : kinds) {
      if (kind.first > 0) warnings_.push_back(std::to_string(kind.first) + " " + kind.second);
    }
  }

  std::string name_;
  std::vector<std::string> warnings_;
  std::vector<SequenceCamera> cameras_;
  std::map<Size, std::size_t> which_;  // of cameras_
  PaveDecoder decoder_;
  PaveStamps stamps_;
  Trajectory truth_;
  std::vector<OdometryState> odometry_;  // always empty
};

}  // namespace

std::unique_ptr<PaveSequence> openPave(const std::string& path, const PaveOptions& options) {
  return std::make_unique<PaveFile>(path, options, readStream(path));
}

}  // namespace ardrone_vslam
