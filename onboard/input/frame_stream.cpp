// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_stream.hpp"

#include <array>
#include <cstdlib>
#include <cstring>

#include "protocol/clocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kLargestNumber = INT64_MAX / 10 - 1;
constexpr const char* kStampComment = " stamp_ns ";

bool isSpace(int c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

std::string sizeText(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

FrameStream::FrameStream(FileDescriptor file, int stop_fd, const FrameSize& size, bool every_frame,
                         std::function<void()> waiting)
    : input_(std::move(file), stop_fd, std::move(waiting)),
      size_(size),
      every_frame_(every_frame),
      pixels_(static_cast<std::size_t>(size.sourceWidth_px()) *
              static_cast<std::size_t>(size.sourceHeight_px()) * 2),
      grey_(static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px)) {}

FrameSource::Read FrameStream::read(Frame& frame) {
  Read answer = readOne();
  while (answer == Read::kFrame && !every_frame_ && input_.hasMore()) {
    const std::int64_t stamp_ns = stamp_ns_;
    const Read next = readOne();
    if (next == Read::kEnd) {  // of the pixels nothing was overwritten
      stamp_ns_ = stamp_ns;
      break;
    }
    ++dropped_;
    answer = next;
  }
  if (answer != Read::kFrame) return answer;
  toGrey(format_, pixels_.data(), size_.sourceWidth_px() * bytesPerPixel(format_),
         size_.sourceWidth_px(), size_.sourceHeight_px(), size_.halve, grey_.data());
  frame.image = {grey_.data(), size_.width_px, size_.height_px, size_.width_px};
  frame.stamp_ns = stamp_ns_;
  return Read::kFrame;
}

FrameSource::Read FrameStream::cutOff() {
  if (input_.isStopped()) return Read::kNone;
  return lost(input_.error() == 0
                  ? std::string("the images end within one: was it written whole?")
                  : std::string("the images cannot be read: ") + std::strerror(input_.error()));
}

FrameSource::Read FrameStream::readOne() {
  const int first = input_.next();
  if (first < 0 && input_.error() != 0) return cutOff();
  if (first < 0) return input_.isStopped() ? Read::kNone : Read::kEnd;
  if (const Read answer = readFormat(first); answer != Read::kFrame) return answer;
  stamp_ns_ = 0;
  Header header{};
  for (std::int64_t* number : {&header.width, &header.height, &header.largest}) {
    if (!readNumber(*number))
      return input_.isStopped() ? Read::kNone : lost("an image's header is damaged or cut off");
  }
  const std::string fault = faultOf(header);
  if (!fault.empty()) return lost(fault);
  const std::size_t bytes = pixels_.size() / 2 * static_cast<std::size_t>(bytesPerPixel(format_));
  return input_.read(pixels_.data(), bytes) == bytes ? Read::kFrame : cutOff();
}

FrameSource::Read FrameStream::readFormat(int first) {
  std::array<std::uint8_t, 4> magic{static_cast<std::uint8_t>(first)};
  const std::size_t letters = first == 'U' ? 4 : 2;
  if (input_.read(&magic[1], letters - 1) != letters - 1) return cutOff();
  const bool is_uyvy = letters == 4 && std::memcmp(magic.data(), "UYVY", 4) == 0;
  if (!is_uyvy && (magic[0] != 'P' || magic[1] != '5' || letters == 4))
    return lost("what comes is neither a binary PGM (P5) nor UYVY (docs/onboard.md)");
  format_ = is_uyvy ? PixelFormat::kUyvy : PixelFormat::kGrey;
  return Read::kFrame;
}

std::string FrameStream::faultOf(const Header& header) const {
  if (stamp_ns_ <= 0) return "an image without its stamp: write '# stamp_ns N' below its P5";
  if (stamp_ns_ > kLatestStamp_ns) return "an image's stamp is no time: it is in nanoseconds";
  const int width_px = size_.sourceWidth_px();
  const int height_px = size_.sourceHeight_px();
  if (header.width == width_px && header.height == height_px && header.largest == 255) return "";
  return "an image of " + sizeText(header.width, header.height) + ", largest value " +
         std::to_string(header.largest) + ", but by the calibration" +
         (size_.halve ? ", doubled as `halve` says," : "") + " it must be " +
         sizeText(width_px, height_px) + ", 255";
}

/// A number of the header, the one space behind it included; comments before it, of which that with
/// the stamp is read.
bool FrameStream::readNumber(std::int64_t& value) {
  int c = input_.next();
  while (isSpace(c) || c == '#') {
    if (c == '#') readComment();
    c = input_.next();
  }
  if (c < '0' || c > '9') return false;
  for (value = 0; c >= '0' && c <= '9'; c = input_.next()) {
    if (value > kLargestNumber) return false;
    value = 10 * value + (c - '0');
  }
  return isSpace(c);
}

void FrameStream::readComment() {
  std::array<char, 64> comment{};
  std::size_t length = 0;
  for (int c = input_.next(); c >= 0 && c != '\n'; c = input_.next()) {
    if (length + 1 < comment.size()) comment[length++] = static_cast<char>(c);
  }
  const std::size_t name = std::strlen(kStampComment);
  if (std::strncmp(comment.data(), kStampComment, name) == 0)
    stamp_ns_ = std::strtoll(comment.data() + name, nullptr, 10);
}

}  // namespace ardrone_vslam
