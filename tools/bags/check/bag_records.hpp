// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// What is wrong with a bag's bytes; names neither file nor remedy.
struct BagFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bytes of known number: a file, or a chunk.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  /// @throws BagFault unless all of it is inside
  void read(std::uint64_t at, void* to, std::size_t count);

 protected:
  virtual void readInside(std::uint64_t at, void* to, std::size_t count) = 0;
};

class FileBytes : public ByteSource {
 public:
  explicit FileBytes(const std::string& path);
  std::uint64_t size() const override { return size_; }

 protected:
  void readInside(std::uint64_t at, void* to, std::size_t count) override;

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }

 protected:
  void readInside(std::uint64_t at, void* to, std::size_t count) override;

 private:
  std::vector<std::uint8_t> bytes_;
};

/// A part of another source, which outlives it.
class PartOfBytes : public ByteSource {
 public:
  PartOfBytes(ByteSource& whole, std::uint64_t begin, std::uint64_t size)
      : whole_(whole), begin_(begin), size_(size) {}
  std::uint64_t size() const override { return size_; }

 protected:
  void readInside(std::uint64_t at, void* to, std::size_t count) override;

 private:
  ByteSource& whole_;
  std::uint64_t begin_;
  std::uint64_t size_;
};

/// The named fields of a record's header: length, name=value (http://wiki.ros.org/Bags/Format/2.0).
class BagFields {
 public:
  BagFields() = default;
  /// @throws BagFault when the lengths do not add up, a name is missing or comes twice
  explicit BagFields(const std::vector<std::uint8_t>& bytes);
  /// There and not empty.
  bool isSet(const std::string& name) const;
  /// @throws BagFault when the field is missing or empty
  const std::string& text(const std::string& name) const;
  /// Little-endian. @throws BagFault when the field is missing or of another size
  std::uint32_t number8(const std::string& name) const;
  std::uint32_t number32(const std::string& name) const;
  std::uint64_t number64(const std::string& name) const;

 private:
  std::uint64_t number(const std::string& name, std::size_t size) const;

  std::map<std::string, std::string> values_;
};

/// Header and place of the data of one record; the data are not read.
struct BagRecord {
  enum Op : std::uint32_t {
    kMessage = 2,
    kBagHeader = 3,
    kIndex = 4,
    kChunk = 5,
    kChunkInfo = 6,
    kConnection = 7
  };

  BagFields fields;
  std::uint64_t data_at = 0;
  std::uint32_t data_size = 0;

  std::uint64_t end() const { return data_at + data_size; }
};

/// @throws BagFault naming the byte: not inside, fields damaged, or another kind of record
BagRecord readBagRecord(ByteSource& source, std::uint64_t at, BagRecord::Op op);

/// All data of a record. @throws BagFault
std::vector<std::uint8_t> readBagData(ByteSource& source, const BagRecord& record);

/// Little-endian. @pre four bytes from `at` are there
std::uint32_t number32At(const std::vector<std::uint8_t>& bytes, std::size_t at);

}  // namespace ardrone_vslam
