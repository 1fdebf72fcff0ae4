// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam {

/// What images must be like.
struct FrameSize {
  int width_px = 0;  ///< as the tracker gets them: after halving
  int height_px = 0;
  bool halve = false;  ///< they come twice as wide and high

  int sourceWidth_px() const { return halve ? 2 * width_px : width_px; }
  int sourceHeight_px() const { return halve ? 2 * height_px : height_px; }
};

struct Frame {
  ImageView image;  ///< valid until the next read()
  std::int64_t stamp_ns = 0;
};

/// Where images come from. Allocates at construction only.
class FrameSource {
 public:
  enum class Read {
    kFrame,  ///< the newest image
    kNone,   ///< none now
    kEnd,    ///< a file's regular end
    kLost    ///< no more will come: fault() says why
  };

  virtual ~FrameSource() = default;
  /// To poll for reading.
  virtual int descriptor() const = 0;
  /// Whether there is something that polling does not tell of.
  virtual bool isBuffered() const { return false; }
  virtual Read read(Frame& frame) = 0;
  /// Images that newer ones made superfluous.
  std::uint32_t dropped() const { return dropped_; }
  /// A sentence with what helps.
  const std::string& fault() const { return fault_; }

 protected:
  Read lost(std::string fault) {
    fault_ = std::move(fault);
    return Read::kLost;
  }

  std::uint32_t dropped_ = 0;

 private:
  std::string fault_;
};

}  // namespace ardrone_vslam
