// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// Fills `content`, whose size is the chunk's, from the packed bytes; `compression` is bz2 or lz4.
/// @throws std::exception when the packed bytes are damaged
using ChunkUnpacker =
    std::function<void(const std::string& compression, std::vector<std::uint8_t>& packed,
                       std::vector<std::uint8_t>& content)>;

/// Checks all that rosbag's reader trusts: it takes lengths and positions from the file as they
/// are, and reads, allocates and jumps by them. Of messages only the headers are read, of
/// compressed chunks everything, as the headers are not to be had otherwise.
/// @throws std::runtime_error naming the file, the fault with its byte, and the remedy; also for
/// bags of format 1.2, encrypted ones, and those without index
void checkBag(const std::string& path, const ChunkUnpacker& unpack);

/// The error for a bag whose bytes are not what they should be.
std::runtime_error unreadableBag(const std::string& path, const std::string& fault);

}  // namespace ardrone_vslam
