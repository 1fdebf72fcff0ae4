// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pave/pave.hpp"

namespace ardrone_vslam {

/// H.264 pictures of PaVE frames by OpenCV's FFmpeg backend, which reads files only and gives all
/// pictures of one file the same size: the payloads are joined in a temporary file for each size.
class PaveDecoder {
 public:
  /// Drops the groups of frames (an IDR picture and those built on it) of which the decoder does
  /// not give exactly one picture a frame, as their pictures could not be told apart.
  /// @param name  of the stream, for messages
  /// @throws std::runtime_error when nothing can be decoded
  PaveDecoder(const std::string& name, std::vector<PaveFrame> frames);
  ~PaveDecoder();

  std::size_t size() const { return headers_.size(); }
  const PaveHeader& header(std::size_t index) const { return headers_.at(index); }
  std::size_t droppedFrames() const { return dropped_frames_; }
  /// 8-bit grey. Going back decodes from the beginning again, at most once for 64
  /// images on end.
  cv::Mat image(std::size_t index);

 private:
  class Reader;

  std::vector<PaveHeader> headers_;
  std::size_t dropped_frames_ = 0;
  std::map<std::pair<int, int>, std::unique_ptr<Reader>> readers_;  // by width and height
  std::vector<std::size_t> indices_;                                // of frames, in their reader
};

}  // namespace ardrone_vslam
