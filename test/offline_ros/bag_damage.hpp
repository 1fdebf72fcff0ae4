// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "bag_recipe.hpp"
#include "bags/bag_sequence.hpp"
#include "bags/check/bag_records.hpp"
#include "bags/messages/bag_open.hpp"
#include "support/read_file.hpp"

namespace ardrone_vslam {

/// The recipe in chunks of at most about 2 KiB, so that there are several.
inline std::string bytesOfRecipe(const BagRecipe& recipe, rosbag::CompressionType compression) {
  TemporaryFolder folder;
  rosbag::Bag bag(folder.file("a.bag"), rosbag::bagmode::Write);
  bag.setChunkThreshold(2048);
  bag.setCompression(compression);
  writeRecipe(bag, recipe);
  bag.close();
  return test::readFile(folder.file("a.bag"));
}

/// Where the records lie that tell the reader where everything else is: all headers and lengths,
/// and the data of index and chunk info.
inline std::vector<std::size_t> structureOf(const std::string& bytes) {
  MemoryBytes source(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  std::vector<std::size_t> positions;
  const auto add = [&positions](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t at = begin; at < end; ++at) positions.push_back(at);
  };
  std::uint64_t at = bytes.find('\n') + 1;
  add(0, at);
  while (at < bytes.size()) {
    BagRecord record;
    for (const auto op : {BagRecord::kBagHeader, BagRecord::kIndex, BagRecord::kChunk,
                          BagRecord::kChunkInfo, BagRecord::kConnection}) {
      try {
        record = readBagRecord(source, at, op);
      } catch (const BagFault&) {
        continue;
      }
      const bool is_index = op == BagRecord::kIndex || op == BagRecord::kChunkInfo;
      add(at, is_index ? record.end() : record.data_at);
      break;
    }
    at = record.end();
  }
  return positions;
}

/// Damages of the kinds that broken disks, transfers and programs do.
class Damage {
 public:
  explicit Damage(std::uint32_t seed) : random_(seed) {}

  /// Another value of the byte, and perhaps of its neighbours.
  std::string at(std::string bytes, std::size_t position) {
    switch (below(4)) {
      case 0:
        bytes[position] = static_cast<char>(bytes[position] ^ (1 << below(8)));
        break;
      case 1:
        bytes[position] = static_cast<char>(below(256));
        break;
      case 2:
        overwrite32(bytes, position, kExtremes[below(kExtremes.size())]);
        break;
      default:
        overwrite32(bytes, position, static_cast<std::uint32_t>(random_() >> below(32)));
        break;
    }
    return bytes;
  }

  /// Blocks lost, zeroed, repeated or filled with noise; one position or several.
  std::string anywhere(std::string bytes) {
    const std::size_t position = below(bytes.size());
    const std::size_t count = std::min<std::size_t>(1 + below(600), bytes.size() - position);
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(position);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    switch (below(5)) {
      case 0:
        bytes.erase(begin, end);
        break;
      case 1:
        std::fill(begin, end, '\0');
        break;
      case 2:
        bytes.insert(position, bytes.substr(below(bytes.size()), count));
        break;
      case 3:
        std::generate(begin, end, [this] { return static_cast<char>(below(256)); });
        break;
      default:
        for (int i = 0; i < 8; ++i) {
          const std::size_t place = below(bytes.size());
          bytes = at(std::move(bytes), place);
        }
    }
    return bytes;
  }

  std::size_t below(std::size_t end) { return random_() % end; }

 private:
  static void overwrite32(std::string& bytes, std::size_t position, std::uint32_t value) {
    for (std::size_t i = 0; i < 4 && position + i < bytes.size(); ++i) {
      bytes[position + i] = static_cast<char>(value >> (8 * i));
    }
  }

  inline static const std::vector<std::uint32_t> kExtremes{
      0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffff8, 0x00ffffff, 0x10000, 0x3d, 0x0fffffff};
  std::mt19937 random_;
};

/// Opens the bag and reads all of it. @return empty, or what the error says
/// @throws what is no std::runtime_error
inline std::string readAll(const std::string& path, const BagReadOptions& options = {}) {
  try {
    const auto bag = openBag(path, options);
    for (std::size_t i = 0; i < bag->size(); ++i) bag->image(i);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return {};
}

}  // namespace ardrone_vslam
