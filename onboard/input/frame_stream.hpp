// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "input/frame_source.hpp"
#include "input/grey_conversion.hpp"
#include "input/input_buffer.hpp"
#include "protocol/file_descriptor.hpp"

namespace ardrone_vslam {

/// Images one after the other in a file, FIFO or standard input (docs/onboard.md): binary PGM with
/// the stamp in a comment, or `UYVY` in place of `P5` and two bytes for each pixel.
///   P5\n# stamp_ns 1234567890\n320 240\n255\n<pixels>
class FrameStream : public FrameSource {
 public:
  /// @param every_frame  false: of those that have come, the newest
  /// @param waiting  called now and then while an image has begun to come and does not go on
  FrameStream(FileDescriptor file, int stop_fd, const FrameSize& size, bool every_frame,
              std::function<void()> waiting = {});

  int descriptor() const override { return input_.descriptor(); }
  bool isBuffered() const override { return input_.isBuffered(); }
  Read read(Frame& frame) override;

 private:
  struct Header {
    std::int64_t width, height, largest;  // value of a pixel
  };

  Read readOne();
  Read readFormat(int first);
  std::string faultOf(const Header& header) const;
  bool readNumber(std::int64_t& value);
  void readComment();
  Read cutOff();

  InputBuffer input_;
  FrameSize size_;
  bool every_frame_;
  PixelFormat format_ = PixelFormat::kGrey;
  std::int64_t stamp_ns_ = 0;
  std::vector<std::uint8_t> pixels_;
  std::vector<std::uint8_t> grey_;
};

}  // namespace ardrone_vslam
