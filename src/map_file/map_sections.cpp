// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/map_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kCameraSize = 16;
constexpr std::size_t kMostCameras = 100;

bool isControl(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code < 0x20 || code == 0x7F;
}

/// Without what would spoil a terminal.
std::string shown(std::string name) {
  std::replace_if(name.begin(), name.end(), isControl, '?');
  return name;
}

std::string textFault(const std::string& what, const std::string& text) {
  if (text.empty() || text.size() > kMostText)
    return what + " has " + std::to_string(text.size()) + " characters, not 1 to " +
           std::to_string(kMostText);
  if (std::any_of(text.begin(), text.end(), isControl))
    return what + " (" + shown(text) + ") has characters that cannot be printed";
  return {};
}

bool isSame(const MapCamera& a, const MapCamera& b) {
  constexpr double kSameFocal = 0.05;  // calibrations of one camera differ by less
  return a.width_px == b.width_px && a.height_px == b.height_px &&
         std::abs(a.focal_length_px - b.focal_length_px) <= kSameFocal * a.focal_length_px;
}

std::string textOf(const MapCamera& c) {
  std::ostringstream text;
  text << c.width_px << " x " << c.height_px << " px, focal length " << c.focal_length_px << " px";
  return text.str();
}

}  // namespace

std::string printable(const SectionTag& tag) {
  std::string text(tag.begin(), tag.end());
  const auto is_odd = [](char c) { return c < ' ' || c > '~'; };
  std::replace_if(text.begin(), text.end(), is_odd, '?');
  return text;
}

void refuseSection(const SectionTag& tag, const std::string& what) {
  throw MapFileError("section " + printable(tag) + " cannot be right: " + what +
                     "; use another copy, or make the map anew");
}

std::string infoFault(const SavedMap& map) {
  const std::string fault = textFault("the name of the frame", map.frame_id);
  if (!fault.empty()) return fault;
  return map.stamp_ns < 0 ? "the stamp is negative" : "";
}

std::string madeFault(const std::string& made_by) {
  return textFault("the name of the program that made the map", made_by);
}

void readMade(ByteReader in, SavedMap& map) {
  map.made_by = in.text(kMostText);
  if (in.isShort() || in.remaining() > 0) refuseSection(kMadeTag, "its size does not fit");
  const std::string fault = madeFault(map.made_by);
  if (!fault.empty()) refuseSection(kMadeTag, fault);
}

void writeInfo(const SavedMap& map, ByteWriter& out) {
  out.text(kDescriptorKind);
  out.text(map.frame_id);
  out.i64(map.stamp_ns);
}

void readInfo(ByteReader in, SavedMap& map) {
  const std::string kind = in.text(kMostText);
  if (!in.isShort() && kind != kDescriptorKind)
    throw MapFileError("its landmarks have descriptors of the kind \"" + shown(kind) +
                       "\", not \"" + kDescriptorKind + "\"; make the map anew");
  map.frame_id = in.text(kMostText);
  map.stamp_ns = in.i64();
  if (in.isShort() || in.remaining() > 0) refuseSection(kInfoTag, "its size does not fit");
  const std::string fault = infoFault(map);
  if (!fault.empty()) refuseSection(kInfoTag, fault);
}

void writeCameras(const std::vector<MapCamera>& cameras, ByteWriter& out) {
  for (const MapCamera& camera : cameras) {
    out.u32(static_cast<std::uint32_t>(camera.width_px));
    out.u32(static_cast<std::uint32_t>(camera.height_px));
    out.f64(camera.focal_length_px);
  }
}

void readCameras(ByteReader in, SavedMap& map) {
  if (in.remaining() % kCameraSize != 0) refuseSection(kCameraTag, "its size does not fit");
  map.cameras.resize(in.remaining() / kCameraSize);
  for (MapCamera& camera : map.cameras) {
    // Beyond an int they are negative.
    camera.width_px = static_cast<int>(in.u32());
    camera.height_px = static_cast<int>(in.u32());
    camera.focal_length_px = in.f64();
  }
  const std::string fault = camerasFault(map.cameras);
  if (!fault.empty()) refuseSection(kCameraTag, fault);
}

std::string camerasFault(const std::vector<MapCamera>& cameras) {
  if (cameras.empty()) return "there is no camera";
  if (cameras.size() > kMostCameras) return "there are more than 100 cameras";
  for (const MapCamera& camera : cameras) {
    if (camera.width_px <= 0 || camera.height_px <= 0) return "the image size is not positive";
    if (!(camera.focal_length_px > 0) || !std::isfinite(camera.focal_length_px))
      return "the focal length is not positive";
  }
  return {};
}

std::string cameraDifference(const std::vector<MapCamera>& of_map, const MapCamera& other) {
  std::string cameras;
  for (const MapCamera& camera : of_map) {
    if (isSame(camera, other)) return {};
    cameras += (cameras.empty() ? "" : " or ") + textOf(camera);
  }
  return "the map was made with another camera (" + cameras + "; now " + textOf(other) +
         "): use a map of this camera";
}

void addCamera(const MapCamera& camera, std::vector<MapCamera>& cameras) {
  const auto is_it = [&camera](const MapCamera& other) { return isSame(other, camera); };
  if (std::none_of(cameras.begin(), cameras.end(), is_it)) cameras.push_back(camera);
}

}  // namespace ardrone_vslam
