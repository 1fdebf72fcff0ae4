// SPDX-License-Identifier: BSD-3-Clause
// A fuzz target without libFuzzer: runs its seeds, the files of its corpus, and mutations of all of
// them, the same in every run.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>

#include "fuzz/fuzz_input.hpp"

namespace ardrone_vslam::fuzz {
namespace {

constexpr std::size_t kMostGrowth_bytes = 64;
constexpr const char* kCrash = "crash";

std::mt19937& randomNumbers() {
  static std::mt19937 numbers(1);
  return numbers;
}

std::size_t below(std::size_t end) {
  return randomNumbers()() % end;
}

/// Numbers that are odd in one type or another, as their bytes.
Bytes oddNumber() {
  constexpr double kOdd[] = {0, -0.0, -1, 1e-320, 1e300, -1e300, HUGE_VAL, NAN};
  const double value = kOdd[below(std::size(kOdd))];
  Bytes bytes;
  switch (below(3)) {
    case 0:
      put(bytes, value);
      break;
    case 1:
      put(bytes, static_cast<std::uint32_t>(below(11) - 5) << 23U);  // of a float, its exponent
      break;
    default:
      put(bytes, static_cast<std::uint32_t>(below(5) - 2));
  }
  return bytes;
}

/// What is at work, for the handler.
const Bytes* at_work = nullptr;

/// Keeps the input that the target fell over.
void keepInput(int signal) {
  const int file = ::open(kCrash, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file >= 0 && at_work != nullptr && ::write(file, at_work->data(), at_work->size()) >= 0)
    ::close(file);
  constexpr char kSaid[] = "the input is kept in the file 'crash'; run the program with its name\n";
  if (::write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) ::_exit(1);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

void run(const Bytes& input) {
  at_work = &input;
  LLVMFuzzerTestOneInput(input.data(), input.size());
  at_work = nullptr;
}

std::vector<Bytes> filesOf(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> paths{path};
  if (std::filesystem::is_directory(path)) {
    paths.assign(std::filesystem::directory_iterator(path), {});
    std::sort(paths.begin(), paths.end());
  }
  std::vector<Bytes> files;
  for (const auto& name : paths) {
    std::ifstream file(name, std::ios::binary);
    if (!file) throw std::runtime_error(name.string() + ": cannot be read");
    files.push_back({std::istreambuf_iterator<char>(file), {}});
  }
  return files;
}

Bytes mutated(Bytes input) {
  const std::size_t size = input.size();
  input.resize(size + kMostGrowth_bytes);
  const auto seed = static_cast<unsigned int>(randomNumbers()());
  input.resize(LLVMFuzzerCustomMutator(input.data(), size, input.size(), seed));
  return input;
}

int runAll(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1 && !std::filesystem::is_directory(arguments[0])) {
    run(filesOf(arguments[0]).front());  // one input again
    return 0;
  }
  if (arguments.size() != 2) {
    std::cerr << "usage: FOLDER MUTATIONS | FILE | --write-seeds FOLDER\n";
    return 2;
  }
  std::vector<Bytes> inputs = seeds();
  require(!inputs.empty(), "a target has seeds");
  if (std::filesystem::exists(arguments[0])) {  // of a target that never fell over there is none
    const std::vector<Bytes> files = filesOf(arguments[0]);
    inputs.insert(inputs.end(), files.begin(), files.end());
  }
  for (const Bytes& input : inputs) run(input);
  const int mutations = std::stoi(arguments[1]);
  for (int i = 0; i < mutations; ++i) {
    Bytes input = inputs[below(inputs.size())];
    for (std::size_t n = below(4); n > 0; --n) input = mutated(std::move(input));
    run(input);
  }
  std::cout << inputs.size() << " inputs, " << mutations << " mutations\n";
  return 0;
}

}  // namespace
}  // namespace ardrone_vslam::fuzz

/// libFuzzer's, made small: one change of a byte, of a number, or of the size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t most_size) {
  using namespace ardrone_vslam::fuzz;
  const std::size_t at = size == 0 ? 0 : below(size);
  const std::size_t count = std::min<std::size_t>(1 + below(16), size - at);
  std::uint8_t* const place = data + at;
  switch (size == 0 ? 0 : below(6)) {
    case 0: {
      const std::size_t grown = std::min<std::size_t>(1 + below(16), most_size - size);
      std::copy_backward(place, data + size, data + size + grown);
      std::generate_n(place, grown, [] { return static_cast<std::uint8_t>(below(256)); });
      return size + grown;
    }
    case 1:
      std::copy(place + count, data + size, place);
      return size - count;
    case 2: {
      const Bytes number = oddNumber();
      std::copy_n(number.begin(), std::min(number.size(), size - at), place);
      return size;
    }
    case 3:
      std::memmove(place, data + below(size - count + 1), count);
      return size;
    case 4:
      *place = static_cast<std::uint8_t>(below(256));
      return size;
    default:
      *place = static_cast<std::uint8_t>(*place ^ (1U << below(8)));
      return size;
  }
}

int main(int argc, char** argv) {
  LLVMFuzzerInitialize(&argc, &argv);
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGALRM})
    std::signal(signal, ardrone_vslam::fuzz::keepInput);
  try {
    return ardrone_vslam::fuzz::runAll({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    ardrone_vslam::fuzz::keepInput(SIGABRT);
    return 1;
  }
}
