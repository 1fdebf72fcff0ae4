// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/section_table.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "map_file/crc32.hpp"

namespace ardrone_vslam {
namespace {

constexpr SectionTag kKnown[] = {kInfoTag,      kCameraTag, kAnchorsTag, kMadeTag,
                                 kLandmarksTag, kFlightTag, kEndTag};
constexpr char kGoesOn[] = "the file is damaged: it goes on behind its last section";
constexpr char kUseNewer[] = "use a newer version of ardrone_vslam";

[[noreturn]] void refuse(const std::string& what) {
  throw MapFileError(what + "; use another copy");
}

/// @return number of sections
std::uint32_t readHeader(const MapFileInput& file) {
  std::array<std::uint8_t, kMapHeaderSize> head{};
  file.read(0, head.data(), head.size());
  if (!std::equal(kMapMagic, kMapMagic + kMapMagicSize, head.begin()))
    throw MapFileError(std::string("this is no map file (it does not begin with ") + kMapMagic +
                       "); name one that was saved as a map");
  ByteReader in(head.data() + kMapMagicSize, head.size() - kMapMagicSize);
  const std::uint32_t schema = in.u32();
  if (schema > kMapSchema)
    throw MapFileError("the map was written by a newer version (schema " + std::to_string(schema) +
                       ", this one knows up to " + std::to_string(kMapSchema) + "); " + kUseNewer);
  if (schema == 0) refuse("the file is damaged (its schema is 0)");
  return in.u32();
}

std::uint32_t checkSum(const MapFileInput& file, std::uint64_t offset, std::uint64_t count) {
  constexpr std::uint64_t kBytesAtOnce = 64 * 1024;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::min(count, kBytesAtOnce)));
  Crc32 crc;
  while (count > 0) {
    const auto size = static_cast<std::size_t>(std::min(count, kBytesAtOnce));
    file.read(offset, bytes.data(), size);
    crc.add(bytes.data(), size);
    offset += size;
    count -= size;
  }
  return crc.value();
}

/// The section that begins at `offset`.
MapSection sectionAt(const MapFileInput& file, std::uint64_t offset) {
  constexpr std::size_t kHead = 12;  // tag and size
  const std::uint64_t left = file.size() - offset;
  if (left < kSectionFrame) refuse("the file is cut short: it ends where a section should begin");
  std::array<std::uint8_t, kHead> head{};
  file.read(offset, head.data(), head.size());
  MapSection section;
  std::copy_n(head.begin(), section.tag.size(), section.tag.begin());
  const auto size = fromLittleEndian<std::uint64_t>(head.data() + section.tag.size());
  if (size > left - kSectionFrame)
    refuse("the file is cut short, or damaged: it ends within section " + printable(section.tag));
  section.offset = offset + kHead;
  section.size = static_cast<std::size_t>(size);
  std::array<std::uint8_t, 4> sum{};
  file.read(section.offset + size, sum.data(), sum.size());
  if (checkSum(file, offset, kHead + size) != fromLittleEndian<std::uint32_t>(sum.data()))
    refuse("section " + printable(section.tag) + " is damaged (its check sum does not fit)");
  return section;
}

bool isKnown(const SectionTag& tag) {
  return std::find(std::begin(kKnown), std::end(kKnown), tag) != std::end(kKnown);
}

bool maySkip(const SectionTag& tag) {
  return tag[0] >= 'a' && tag[0] <= 'z';
}

}  // namespace

SectionTable::SectionTable(const MapFileInput& file) {
  const std::uint32_t count = readHeader(file);
  std::uint64_t offset = kMapHeaderSize;
  for (std::uint32_t i = 0; i < count; ++i) {
    const MapSection section = sectionAt(file, offset);
    offset += kSectionFrame + section.size;
    add(section);
    if (section.tag == kEndTag && i + 1 < count) refuse(kGoesOn);
  }
  if (offset < file.size()) refuse(kGoesOn);
  const MapSection& end = find(kEndTag);
  std::array<std::uint8_t, 8> size{};
  if (end.size == size.size()) file.read(end.offset, size.data(), size.size());
  if (fromLittleEndian<std::uint64_t>(size.data()) != file.size())
    refuse("the file has another size than it was written with");
}

void SectionTable::add(const MapSection& section) {
  if (!isKnown(section.tag)) {
    if (maySkip(section.tag)) return;
    throw MapFileError("the map has a section " + printable(section.tag) +
                       " that this version does not know and may not skip; " + kUseNewer);
  }
  if (search(section.tag) != nullptr)
    refuse("section " + printable(section.tag) + " is there twice");
  sections_.push_back(section);
}

const MapSection* SectionTable::search(const SectionTag& tag) const {
  const auto found = std::find_if(sections_.begin(), sections_.end(),
                                  [&tag](const MapSection& section) { return section.tag == tag; });
  return found == sections_.end() ? nullptr : &*found;
}

const MapSection& SectionTable::find(const SectionTag& tag) const {
  const MapSection* const found = search(tag);
  if (found == nullptr) refuse("the file is damaged: section " + printable(tag) + " is missing");
  return *found;
}

}  // namespace ardrone_vslam
