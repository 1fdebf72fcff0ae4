// SPDX-License-Identifier: BSD-3-Clause
// What a fuzz target is. scripts/fuzz links it with libFuzzer, every other build with
// run_corpus.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// libFuzzer's names.
// NOLINTBEGIN(readability-identifier-naming)
/// Gives hostile bytes to the code under test. Stops the program where a promise is broken.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// Called once at the start. With --write-seeds FOLDER the program does that alone.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
/// A mutation, then a repair.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most_size, unsigned int seed);
/// One of libFuzzer's mutations; without it one of run_corpus.cpp's.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t most_size);
// NOLINTEND(readability-identifier-naming)

namespace ardrone_vslam::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Sound inputs that the search starts from; each target has its own.
std::vector<Bytes> seeds();

/// Makes check sums and lengths right again after a mutation, so that they do not keep the search
/// out. Targets without any leave the input as it is.
/// @return the new size, at most `most_size`
std::size_t repair(std::uint8_t* data, std::size_t size, std::size_t most_size);

/// Stops the program unless a promise holds: for libFuzzer and for ctest that is a crash.
void require(bool holds, const std::string& promise);

inline Bytes bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

}  // namespace ardrone_vslam::fuzz
