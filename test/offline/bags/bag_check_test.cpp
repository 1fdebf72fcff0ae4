// SPDX-License-Identifier: BSD-3-Clause
// The check of a bag's bytes, on bags written here by the format's description; no ROS.
#include "bags/check/bag_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bags/check/bag_records.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

using Fields = std::vector<std::pair<std::string, std::string>>;

template <class Number>
std::string bytesOf(Number number) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(number); ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i));
  }
  return bytes;
}

std::string u32(std::uint32_t number) {
  return bytesOf(number);
}
std::string u64(std::uint64_t number) {
  return bytesOf(number);
}

std::string header(const Fields& fields) {
  std::string bytes;
  for (const auto& field : fields) {
    const std::string text = field.first + "=" + field.second;
    bytes += u32(static_cast<std::uint32_t>(text.size())) + text;
  }
  return bytes;
}

std::string record(char op, Fields fields, const std::string& data) {
  fields.emplace_back("op", std::string(1, op));
  const std::string head = header(fields);
  return u32(static_cast<std::uint32_t>(head.size())) + head +
         u32(static_cast<std::uint32_t>(data.size())) + data;
}

/// One connection, one chunk, two messages; each test changes what it is about.
struct BagParts {
  std::string version = "#ROSBAG V2.0\n";
  std::string compression = "none";
  std::uint32_t connection = 0;        ///< of chunk info and index
  std::uint32_t second_offset = 0;     ///< added to the second message's true place
  std::uint64_t chunk_shift = 0;       ///< added to the chunk's true place
  std::uint32_t entries = 2;           ///< said to be in the index
  std::uint32_t size_excess = 0;       ///< of the chunk
  std::uint32_t connection_count = 1;  ///< in the bag's header
  std::uint32_t index_version = 1;
  std::uint32_t nanoseconds = 5;
  Fields more_of_bag;
  bool has_index = true;

  std::string bytes() const {
    const std::string message = record(2, {{"conn", u32(0)}, {"time", u64(1)}}, "payload");
    const std::string chunk =
        record(5,
               {{"compression", compression},
                {"size", u32(static_cast<std::uint32_t>(2 * message.size()) + size_excess)}},
               message + message);
    const auto second = static_cast<std::uint32_t>(message.size()) + second_offset;
    const std::string index =
        record(4, {{"conn", u32(connection)}, {"ver", u32(index_version)}, {"count", u32(entries)}},
               u32(1) + u32(nanoseconds) + u32(0) + u32(1) + u32(6) + u32(second));
    const std::string bag_header_size = bagHeader(0);
    const std::uint64_t chunk_at = version.size() + bag_header_size.size();
    const std::uint64_t index_at = has_index ? chunk_at + chunk.size() + index.size() : 0;
    const std::string connections =
        record(7, {{"conn", u32(0)}, {"topic", "/a"}},
               header({{"topic", "/a"}, {"type", "std_msgs/String"}, {"md5sum", "0123"}}));
    const std::string info = record(6,
                                    {{"ver", u32(1)},
                                     {"chunk_pos", u64(chunk_at + chunk_shift)},
                                     {"start_time", u64(1)},
                                     {"end_time", u64(1)},
                                     {"count", u32(1)}},
                                    u32(connection) + u32(2));
    return version + bagHeader(index_at) + chunk + index + connections + info;
  }

 private:
  std::string bagHeader(std::uint64_t index_at) const {
    Fields fields{{"index_pos", u64(index_at)},
                  {"conn_count", u32(connection_count)},
                  {"chunk_count", u32(1)}};
    fields.insert(fields.end(), more_of_bag.begin(), more_of_bag.end());
    return record(3, fields, std::string(64, ' '));
  }
};

class BagCheck : public testing::Test {
 protected:
  void check(const std::string& bytes) {
    folder_.write("a.bag", bytes);
    checkBag(folder_.file("a.bag"), unpack_);
  }
  void expectRefused(const BagParts& parts, const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.push_back(folder_.file("a.bag"));
    expectError([&] { check(parts.bytes()); }, all);
  }

  TemporaryFolder folder_;
  ChunkUnpacker unpack_ = [](const std::string&, std::vector<std::uint8_t>& packed,
                             std::vector<std::uint8_t>& content) {
    if (packed.size() != content.size()) throw std::runtime_error("cannot unpack");
    content = packed;
  };
};

TEST_F(BagCheck, ASoundBagPasses) {
  EXPECT_NO_THROW(check(BagParts().bytes()));
  for (const char* compression : {"bz2", "lz4"}) {
    BagParts packed;
    packed.compression = compression;
    EXPECT_NO_THROW(check(packed.bytes()));
  }
  BagParts plain;
  plain.more_of_bag = {{"encryptor", ""}};
  EXPECT_NO_THROW(check(plain.bytes()));
}

TEST_F(BagCheck, OtherBagsHaveTheirOwnRemedy) {
  BagParts parts;
  parts.has_index = false;
  expectRefused(parts, {"no index", "rosbag reindex"});
  parts = BagParts();
  parts.more_of_bag = {{"encryptor", "rosbag/AesCbcEncryptor"}};
  expectRefused(parts, {"encrypted", "rosbag decrypt"});
  parts = BagParts();
  parts.version = "#ROSBAG V1.2\n";
  expectRefused(parts, {"older format", "rosbag fix"});
  parts.version = "#ROSRECORD V1.1\n";
  expectRefused(parts, {"older format", "rosbag fix"});
  parts.version = "#ROSBAG V3.0\n";
  expectRefused(parts, {"no readable bag", "#ROSBAG V2.0"});
}

TEST_F(BagCheck, WhatDoesNotFitIsNamed) {
  const auto refused = [this](auto change, const std::vector<std::string>& words) {
    BagParts parts;
    change(parts);
    expectRefused(parts, words);
  };
  refused([](BagParts& p) { p.connection = 4; }, {"no connection 4"});
  refused([](BagParts& p) { p.second_offset = 1; }, {"leads to no message"});
  refused([](BagParts& p) { p.second_offset = 1u << 31; }, {"leads to no message", "the end"});
  refused([](BagParts& p) { p.chunk_shift = 1; }, {"byte "});
  refused([](BagParts& p) { p.chunk_shift = 1ull << 63; }, {"beyond the end"});
  refused([](BagParts& p) { p.entries = 3; }, {"24 bytes instead of 36"});
  refused([](BagParts& p) { p.entries = 0x40000002; }, {"bytes instead of"});
  refused([](BagParts& p) { p.size_excess = 1; }, {"bytes instead of"});
  refused([](BagParts& p) { p.size_excess = 1u << 31; }, {"a chunk of 21474"});
  refused([](BagParts& p) { p.connection_count = 2; }, {"another kind of record"});
  refused([](BagParts& p) { p.connection_count = 0; }, {"another kind of record"});
  refused([](BagParts& p) { p.index_version = 0; }, {"another version"});
  refused([](BagParts& p) { p.nanoseconds = 1'000'000'000; }, {"10^9"});
  refused([](BagParts& p) { p.compression = "zip"; }, {"none, bz2, lz4"});
  refused([](BagParts& p) { p.more_of_bag = {{"conn_count", u32(1)}}; }, {"twice"});
  refused(
      [](BagParts& p) {
        p.compression = "lz4";
        p.size_excess = 1;
      },
      {"cannot be unpacked", "cannot unpack"});
}

TEST_F(BagCheck, DamagedAndCutOffBytesPassOrAreRefusedByName) {
  const std::string whole = BagParts().bytes();
  std::mt19937 random(3);
  int refused = 0;
  const auto tryBytes = [&](const std::string& bytes) {
    try {
      check(bytes);
    } catch (const std::runtime_error& e) {
      ++refused;
      EXPECT_NE(std::string(e.what()).find(folder_.file("a.bag")), std::string::npos) << e.what();
    }
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(random());
    tryBytes(bytes);
  }
  EXPECT_GT(refused, static_cast<int>(whole.size() / 4));
  refused = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) tryBytes(whole.substr(0, size));
  EXPECT_EQ(refused, static_cast<int>(whole.size()));
}

}  // namespace
}  // namespace ardrone_vslam
