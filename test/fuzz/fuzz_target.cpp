// SPDX-License-Identifier: BSD-3-Clause
// What libFuzzer asks of every target.
#include "fuzz/fuzz_target.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace ardrone_vslam::fuzz {
namespace {

void writeSeeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const Bytes& seed : seeds()) {
    std::ofstream file(folder / ("seed_" + std::to_string(number++)), std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.data()),
               static_cast<std::streamsize>(seed.size()));
    if (!file) throw std::runtime_error(folder.string() + ": the seeds cannot be written there");
  }
}

}  // namespace

void require(bool holds, const std::string& promise) {
  if (holds) return;
  std::cerr << "broken promise: " << promise << std::endl;
  std::abort();
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc == 3 && std::string((*argv)[1]) == "--write-seeds") {
    ardrone_vslam::fuzz::writeSeeds((*argv)[2]);
    std::exit(0);
  }
  return 0;
}

/// One mutation in eight is left as it is: damage that check sums tell of must be looked for, too.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most_size, unsigned int seed) {
  size = LLVMFuzzerMutate(data, size, most_size);
  return seed % 8 == 0 ? size : ardrone_vslam::fuzz::repair(data, size, most_size);
}
