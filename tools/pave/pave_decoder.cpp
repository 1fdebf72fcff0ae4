// SPDX-License-Identifier: BSD-3-Clause
#include "pave/pave_decoder.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <utility>

namespace ardrone_vslam {
namespace {

using FrameIterator = std::vector<PaveFrame>::const_iterator;

/// The payloads of some frames as a .h264 file, removed in the end.
class TemporaryStream {
 public:
  TemporaryStream(FrameIterator begin, FrameIterator end) {
    path_ = (std::filesystem::temp_directory_path() / "ardrone_vslam_XXXXXX.h264").string();
    const int descriptor = mkstemps(path_.data(), 5);
    if (descriptor < 0) {
      throw std::runtime_error(path_ + ": cannot be made; set TMPDIR to a folder with free space");
    }
    close(descriptor);
    std::ofstream file(path_, std::ios::binary);
    for (auto frame = begin; frame != end; ++frame) {
      file.write(reinterpret_cast<const char*>(frame->payload.data()),
                 static_cast<std::streamsize>(frame->payload.size()));
    }
    file.close();
    if (!file) {
      std::filesystem::remove(path_);
      throw std::runtime_error(path_ + ": cannot be written; set TMPDIR to a folder with space");
    }
  }
  ~TemporaryStream() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryStream(const TemporaryStream&) = delete;
  TemporaryStream& operator=(const TemporaryStream&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::size_t countPictures(FrameIterator begin, FrameIterator end) {
  const TemporaryStream stream(begin, end);
  cv::VideoCapture capture(stream.path(), cv::CAP_FFMPEG);
  std::size_t count = 0;
  while (capture.isOpened() && capture.grab()) ++count;
  return count;
}

/// The groups that give one picture for each frame.
std::vector<PaveFrame> soundGroups(const std::vector<PaveFrame>& frames) {
  std::vector<PaveFrame> sound;
  for (auto begin = frames.begin(); begin != frames.end();) {
    auto end = std::next(begin);
    while (end != frames.end() && end->header.frame_type != PaveHeader::kIdr) ++end;
    if (countPictures(begin, end) == static_cast<std::size_t>(end - begin)) {
      sound.insert(sound.end(), begin, end);
    }
    begin = end;
  }
  return sound;
}

}  // namespace

class PaveDecoder::Reader {
 public:
  Reader(std::string name, const std::vector<PaveFrame>& frames)
      : name_(std::move(name)), stream_(frames.begin(), frames.end()) {
    rewind();
  }

  cv::Mat image(std::size_t index) {
    if (index >= next_index_) return decode(index);
    if (index < kept_begin_ || index >= kept_begin_ + kept_.size()) keepUpTo(index);
    return kept_[index - kept_begin_].clone();
  }

 private:
  static constexpr std::size_t kKept = 64;  // pictures; 15 MB at 640x360

  /// Whoever goes back mostly goes on backward, and each beginning costs the whole way.
  void keepUpTo(std::size_t index) {
    kept_.clear();
    kept_begin_ = index < kKept ? 0 : index + 1 - kKept;
    rewind();
    for (std::size_t i = kept_begin_; i <= index; ++i) kept_.push_back(decode(i));
  }

  /// @pre index >= next_index_
  cv::Mat decode(std::size_t index) {
    bool is_grabbed = true;
    for (; is_grabbed && next_index_ <= index; ++next_index_) is_grabbed = capture_.grab();
    cv::Mat picture;
    if (!is_grabbed || !capture_.retrieve(picture) || picture.empty()) {
      throw std::runtime_error(name_ + ": the video decoder gave no picture for frame " +
                               std::to_string(index));
    }
    cv::Mat grey;
    if (picture.channels() == 1) {
      grey = picture.clone();
    } else {
      cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    }
    return grey;
  }

  void rewind() {
    if (!capture_.open(stream_.path(), cv::CAP_FFMPEG)) {
      throw std::runtime_error(
          name_ +
          ": OpenCV cannot decode H.264; it must be built with FFmpeg (Debian's libopencv-dev is)");
    }
    next_index_ = 0;
  }

  std::string name_;
  TemporaryStream stream_;
  cv::VideoCapture capture_;
  std::size_t next_index_ = 0;
  std::vector<cv::Mat> kept_;  // pictures from kept_begin_ on, when asked for backward
  std::size_t kept_begin_ = 0;
};

PaveDecoder::PaveDecoder(const std::string& name, std::vector<PaveFrame> frames) {
  const std::size_t frame_count = frames.size();
  if (countPictures(frames.begin(), frames.end()) != frame_count) frames = soundGroups(frames);
  if (frames.empty()) {
    throw std::runtime_error(name +
                             ": no picture can be decoded; the stream must hold H.264 with an IDR "
                             "picture, and OpenCV must be built with FFmpeg");
  }
  dropped_frames_ = frame_count - frames.size();
  std::map<std::pair<int, int>, std::vector<PaveFrame>> frames_of_size;
  for (PaveFrame& frame : frames) {
    headers_.push_back(frame.header);
    auto& same_size = frames_of_size[{frame.header.width_px, frame.header.height_px}];
    indices_.push_back(same_size.size());
    same_size.push_back(std::move(frame));
  }
  for (const auto& one : frames_of_size)
    readers_[one.first] = std::make_unique<Reader>(name, one.second);
}

PaveDecoder::~PaveDecoder() = default;

cv::Mat PaveDecoder::image(std::size_t index) {
  const PaveHeader& header = headers_.at(index);
  return readers_.at({header.width_px, header.height_px})->image(indices_[index]);
}

}  // namespace ardrone_vslam
