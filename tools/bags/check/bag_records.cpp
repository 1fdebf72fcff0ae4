// SPDX-License-Identifier: BSD-3-Clause
#include "bags/check/bag_records.hpp"

#include <algorithm>
#include <cstring>

namespace ardrone_vslam {
namespace {

/// A header holds numbers and a topic's name; a message's definition is data.
constexpr std::uint32_t kMaxHeader_bytes = 1 << 20;

std::string atByte(std::uint64_t at, const std::string& what) {
  return "byte " + std::to_string(at) + ": " + what;
}

std::uint32_t readNumber32(ByteSource& source, std::uint64_t at) {
  std::vector<std::uint8_t> bytes(4);
  source.read(at, bytes.data(), bytes.size());
  return number32At(bytes, 0);
}

}  // namespace

void ByteSource::read(std::uint64_t at, void* to, std::size_t count) {
  if (at > size() || count > size() - at) {
    throw BagFault(atByte(at, "a record reaches beyond the end"));
  }
  if (count > 0) readInside(at, to, count);
}

FileBytes::FileBytes(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
  if (!file_) throw BagFault("cannot be opened for reading");
  size_ = static_cast<std::uint64_t>(file_.tellg());
  position_ = size_;
}

void FileBytes::readInside(std::uint64_t at, void* to, std::size_t count) {
  // Seeking throws away what the stream has read ahead.
  if (at != position_) file_.seekg(static_cast<std::streamoff>(at));
  if (!file_.read(static_cast<char*>(to), static_cast<std::streamsize>(count))) {
    throw BagFault(atByte(at, "cannot be read"));
  }
  position_ = at + count;
}

void MemoryBytes::readInside(std::uint64_t at, void* to, std::size_t count) {
  std::memcpy(to, bytes_.data() + at, count);
}

void PartOfBytes::readInside(std::uint64_t at, void* to, std::size_t count) {
  whole_.read(begin_ + at, to, count);
}

BagFields::BagFields(const std::vector<std::uint8_t>& bytes) {
  std::size_t at = 0;
  while (at < bytes.size()) {
    if (bytes.size() - at < 4) throw BagFault("a header's last field is cut off");
    const std::size_t size = number32At(bytes, at);
    at += 4;
    if (size > bytes.size() - at) throw BagFault("a field is longer than its header");
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = begin + static_cast<std::ptrdiff_t>(size);
    const auto equals = std::find(begin, end, '=');
    if (equals == begin || equals == end) throw BagFault("a header's field has no name");
    if (!values_.emplace(std::string(begin, equals), std::string(equals + 1, end)).second) {
      throw BagFault("a header's field is there twice");
    }
    at += size;
  }
}

bool BagFields::isSet(const std::string& name) const {
  const auto field = values_.find(name);
  return field != values_.end() && !field->second.empty();
}

const std::string& BagFields::text(const std::string& name) const {
  const auto field = values_.find(name);
  if (field == values_.end()) throw BagFault("the field '" + name + "' is missing");
  if (field->second.empty()) throw BagFault("the field '" + name + "' is empty");
  return field->second;
}

std::uint64_t BagFields::number(const std::string& name, std::size_t size) const {
  const std::string& bytes = text(name);
  if (bytes.size() != size) {
    throw BagFault("the field '" + name + "' has " + std::to_string(bytes.size()) + " bytes, not " +
                   std::to_string(size));
  }
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= std::uint64_t{static_cast<std::uint8_t>(bytes[i])} << (8 * i);
  }
  return value;
}

std::uint32_t BagFields::number8(const std::string& name) const {
  return static_cast<std::uint32_t>(number(name, 1));
}

std::uint32_t BagFields::number32(const std::string& name) const {
  return static_cast<std::uint32_t>(number(name, 4));
}

std::uint64_t BagFields::number64(const std::string& name) const {
  return number(name, 8);
}

BagRecord readBagRecord(ByteSource& source, std::uint64_t at, BagRecord::Op op) {
  const std::uint32_t header_size = readNumber32(source, at);
  if (header_size > kMaxHeader_bytes) {
    throw BagFault(atByte(at, "a header of " + std::to_string(header_size) + " bytes"));
  }
  std::vector<std::uint8_t> header(header_size);
  source.read(at + 4, header.data(), header.size());
  BagRecord record;
  record.data_size = readNumber32(source, at + 4 + header_size);
  record.data_at = at + 8 + header_size;
  if (record.data_size > source.size() - record.data_at) {
    throw BagFault(atByte(at, "a record reaches beyond the end"));
  }
  try {
    record.fields = BagFields(header);
    if (record.fields.number8("op") != op) {
      throw BagFault("another kind of record is expected here");
    }
  } catch (const BagFault& fault) {
    throw BagFault(atByte(at, fault.what()));
  }
  return record;
}

std::vector<std::uint8_t> readBagData(ByteSource& source, const BagRecord& record) {
  std::vector<std::uint8_t> data(record.data_size);
  source.read(record.data_at, data.data(), data.size());
  return data;
}

std::uint32_t number32At(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{bytes[at + i]} << (8 * i);
  return value;
}

}  // namespace ardrone_vslam
