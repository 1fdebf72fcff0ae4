// SPDX-License-Identifier: BSD-3-Clause
#include "bags/check/bag_check.hpp"

#include <memory>
#include <set>

#include "bags/check/bag_records.hpp"

namespace ardrone_vslam {
namespace {

const std::string kVersionLine = "#ROSBAG V2.0\n";
/// rosbag's writer makes chunks of 768 KiB, and its reader cannot double a buffer beyond 2 GiB.
constexpr std::uint32_t kMaxChunk_bytes = 1U << 30;
/// A packed chunk is unpacked here, and its size may be a damaged one.
constexpr std::uint32_t kMaxPackedChunk_bytes = 1U << 28;
/// rosbag's reader asserts more than that in a chunk.
constexpr std::uint32_t kMinChunk_bytes = 9;
constexpr std::uint32_t kIndexEntry_bytes = 12;  // sec, nsec, offset
constexpr std::uint32_t kChunkCount_bytes = 8;   // connection, messages

/// A fault that has a remedy of its own.
struct OtherBag : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class BagChecker {
 public:
  BagChecker(ByteSource& file, const ChunkUnpacker& unpack) : file_(file), unpack_(unpack) {}

  void check() {
    checkVersion();
    const BagRecord header = readBagRecord(file_, kVersionLine.size(), BagRecord::kBagHeader);
    if (header.fields.isSet("encryptor")) {
      throw OtherBag("is encrypted; decrypt it by: rosbag decrypt");
    }
    std::uint64_t at = header.fields.number64("index_pos");
    if (at == 0) {
      throw OtherBag("has no index, as its recording was cut off; repair it by: rosbag reindex");
    }
    const std::uint32_t connections = header.fields.number32("conn_count");
    for (std::uint32_t i = 0; i < connections; ++i) at = readConnection(at);
    const std::uint32_t chunks = header.fields.number32("chunk_count");
    for (std::uint32_t i = 0; i < chunks; ++i) at = checkChunkInfo(at);
  }

 private:
  void checkVersion() {
    std::string line(kVersionLine.size(), '\0');
    file_.read(0, &line[0], line.size());
    if (line == kVersionLine) return;
    for (const char* const old : {"#ROSRECORD V1", "#ROSBAG V1", "#ROSLOG V1"}) {
      if (line.rfind(old, 0) == 0) {
        throw OtherBag("is a bag of an older format than 2.0; convert it by: rosbag fix");
      }
    }
    throw BagFault("byte 0: does not begin with #ROSBAG V2.0");
  }

  /// @return where the next record begins
  std::uint64_t readConnection(std::uint64_t at) {
    const BagRecord record = readBagRecord(file_, at, BagRecord::kConnection);
    record.fields.text("topic");
    const BagFields connection(readBagData(file_, record));
    connection.text("type");
    connection.text("md5sum");
    connections_.insert(record.fields.number32("conn"));
    return record.end();
  }

  void requireKnown(std::uint32_t connection, std::uint64_t at) const {
    if (connections_.count(connection) != 0) return;
    throw BagFault("byte " + std::to_string(at) + ": there is no connection " +
                   std::to_string(connection));
  }

  std::uint64_t checkChunkInfo(std::uint64_t at) {
    const BagRecord info = readBagRecord(file_, at, BagRecord::kChunkInfo);
    requireVersion1(info);
    info.fields.number64("start_time");
    info.fields.number64("end_time");
    const std::uint64_t count = info.fields.number32("count");
    requireSize(info, count * kChunkCount_bytes);
    const auto counts = readBagData(file_, info);
    std::set<std::uint32_t> connections;
    for (std::size_t i = 0; i < count; ++i) {
      connections.insert(number32At(counts, i * kChunkCount_bytes));
      requireKnown(number32At(counts, i * kChunkCount_bytes), info.data_at);
    }
    if (connections.size() != count) {
      throw BagFault("byte " + std::to_string(at) + ": counts a connection twice");
    }
    checkChunk(info.fields.number64("chunk_pos"), count);
    return info.end();
  }

  /// The chunk and the index records behind it.
  void checkChunk(std::uint64_t at, std::uint64_t index_records) {
    const BagRecord chunk = readBagRecord(file_, at, BagRecord::kChunk);
    const auto content = openContent(chunk);
    std::uint64_t index_at = chunk.end();
    for (std::uint64_t i = 0; i < index_records; ++i) index_at = checkIndex(index_at, *content);
  }

  std::unique_ptr<ByteSource> openContent(const BagRecord& chunk) {
    const std::string place = "byte " + std::to_string(chunk.data_at) + ": ";
    const std::string& compression = chunk.fields.text("compression");
    const std::uint32_t size = chunk.fields.number32("size");
    const std::uint32_t max_size = compression == "none" ? kMaxChunk_bytes : kMaxPackedChunk_bytes;
    if (size < kMinChunk_bytes || size > max_size) {
      throw BagFault(place + "a chunk of " + std::to_string(size) + " bytes");
    }
    if (compression == "none") {
      requireSize(chunk, size);
      return std::make_unique<PartOfBytes>(file_, chunk.data_at, size);
    }
    if (compression != "bz2" && compression != "lz4") {
      throw BagFault(place + "the chunk's compression is none of none, bz2, lz4");
    }
    auto packed = readBagData(file_, chunk);
    // What unpacking leaves out is zero, and a record's header is not.
    std::vector<std::uint8_t> content(size, 0);
    try {
      unpack_(compression, packed, content);
    } catch (const std::exception& e) {
      throw BagFault(place + "the chunk cannot be unpacked: " + e.what());
    }
    return std::make_unique<MemoryBytes>(std::move(content));
  }

  std::uint64_t checkIndex(std::uint64_t at, ByteSource& content) {
    const BagRecord index = readBagRecord(file_, at, BagRecord::kIndex);
    requireVersion1(index);
    const std::uint32_t connection = index.fields.number32("conn");
    requireKnown(connection, at);
    const std::uint64_t count = index.fields.number32("count");
    requireSize(index, count * kIndexEntry_bytes);
    const auto entries = readBagData(file_, index);
    for (std::size_t i = 0; i < entries.size(); i += kIndexEntry_bytes) {
      const std::uint64_t entry_at = index.data_at + i;
      if (number32At(entries, i + 4) >= 1'000'000'000) {
        throw BagFault("byte " + std::to_string(entry_at) + ": a stamp with 10^9 ns or more");
      }
      try {
        const BagRecord message =
            readBagRecord(content, number32At(entries, i + 8), BagRecord::kMessage);
        if (message.fields.number32("conn") != connection) throw BagFault("of another connection");
      } catch (const BagFault& fault) {
        throw BagFault("byte " + std::to_string(entry_at) +
                       ": leads to no message, in its chunk: " + fault.what());
      }
    }
    return index.end();
  }

  static void requireVersion1(const BagRecord& record) {
    if (record.fields.number32("ver") == 1) return;
    throw BagFault("byte " + std::to_string(record.data_at) + ": an index of another version");
  }

  static void requireSize(const BagRecord& record, std::uint64_t size) {
    if (record.data_size == size) return;
    throw BagFault("byte " + std::to_string(record.data_at) + ": " +
                   std::to_string(record.data_size) + " bytes instead of " + std::to_string(size));
  }

  ByteSource& file_;
  const ChunkUnpacker& unpack_;
  std::set<std::uint32_t> connections_;
};

}  // namespace

void checkBag(const std::string& path, const ChunkUnpacker& unpack) {
  try {
    FileBytes file(path);
    BagChecker(file, unpack).check();
  } catch (const BagFault& fault) {
    throw unreadableBag(path, fault.what());
  } catch (const OtherBag& other) {
    throw std::runtime_error(path + ": " + other.what() + " " + path);
  }
}

std::runtime_error unreadableBag(const std::string& path, const std::string& fault) {
  return std::runtime_error(path + ": is no readable bag (" + fault +
                            "): truncated, damaged or another file; record it again, or try: "
                            "rosbag reindex " +
                            path);
}

}  // namespace ardrone_vslam
