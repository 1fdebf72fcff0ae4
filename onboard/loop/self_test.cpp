// SPDX-License-Identifier: BSD-3-Clause
#include "loop/self_test.hpp"

#include <sys/auxv.h>
#include <sys/stat.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <vector>

#include "ardrone_vslam/instruction_set.hpp"
#include "input/frame_input.hpp"
#include "protocol/clocks.hpp"
#include "protocol/file_descriptor.hpp"
#include "yaml/calibration.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 240;

bool report(bool is_good, const char* what, const std::string& found) {
  std::printf("%-6s %-10s %s\n", is_good ? "ok" : "FAULT", what, found.c_str());
  return is_good;
}

bool testProcessor() {
  const std::string kernels = nameOf(instructionSetInUse().set);
#if defined(__arm__)
  constexpr unsigned long kNeon = 1UL << 12;  // of AT_HWCAP
  const bool has_neon = (::getauxval(AT_HWCAP) & kNeon) != 0;
  return report(has_neon && instructionSetInUse().set == InstructionSet::kNeon, "processor",
                std::string(has_neon ? "NEON" : "no NEON, which every AR.Drone 2.0 has") +
                    ", kernels in use: " + kernels);
#else
  return report(true, "processor", "kernels in use: " + kernels);
#endif
}

bool testClock() {
  constexpr int kReadings = 10000;
  std::int64_t last = now_ns();
  std::int64_t largest_ns = 0;
  for (int i = 0; i < kReadings; ++i) {
    const std::int64_t next = now_ns();
    if (next < last) return report(false, "clock", "CLOCK_MONOTONIC goes back");
    largest_ns = std::max(largest_ns, next - last);
    last = next;
  }
  timespec resolution{};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  const long resolution_ns = resolution.tv_sec > 0 ? 1'000'000'000L : resolution.tv_nsec;
  return report(resolution_ns <= 1'000'000, "clock",
                "monotonic, resolution " + std::to_string(resolution_ns) + " ns, largest step " +
                    std::to_string(largest_ns / 1000) + " us");
}

/// Noise of several pixels' size, moved by some pixels.
std::vector<std::uint8_t> generatedPixels(int shift_x, int shift_y) {
  constexpr int kBlock_px = 5;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t{kWidth_px} * kHeight_px);
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      const auto column = static_cast<std::uint32_t>((x + shift_x) / kBlock_px);
      const auto row = static_cast<std::uint32_t>((y + shift_y) / kBlock_px);
      std::uint32_t h = column * 374761393U + row * 668265263U + 1;
      h = (h ^ (h >> 13)) * 1274126177U;
      h ^= h >> 16;
      pixels.push_back(static_cast<std::uint8_t>(h >> 24));
    }
  }
  return pixels;
}

template <class T>
void mix(std::uint64_t& hash, T value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    hash = (hash ^ (static_cast<std::uint64_t>(value) >> (8 * i) & 255)) * 0x100000001b3U;
}

bool testKernels() {
  const std::uint64_t hash = kernelHash();
  char text[80];
  std::snprintf(text, sizeof text, "corners, descriptors and tracks: %016" PRIx64 "%s", hash,
                hash == kGoldenHash ? ", as they must be" : ", not as they must be");
  return report(hash == kGoldenHash, "kernels", text);
}

bool testMemory(const Settings& settings) {
  const std::size_t bytes = memory_bytes(settings) / 8 * 7;  // at once, of what was taken
  const std::unique_ptr<std::uint8_t[]> memory(new (std::nothrow) std::uint8_t[bytes]);
  const std::string amount = std::to_string(bytes / 1'000'000) + " MB";
  if (!memory) return report(false, "memory", amount + " in one piece cannot be had");
  std::memset(memory.get(), 0x5a, bytes);
  std::size_t good = 0;
  for (std::size_t i = 0; i < bytes; i += 4096) good += memory[i] == 0x5a;
  return report(good == (bytes + 4095) / 4096, "memory", amount + " can be written and read");
}

bool testCamera(const Settings& settings) {
  struct stat status {};
  const std::string& path = settings.onboard.frames;
  const bool is_file =
      path == "-" || (::stat(path.c_str(), &status) == 0 && !S_ISCHR(status.st_mode));
  if (is_file) return report(true, "camera", path + " is no device: not tested");
  try {
    const CameraIntrinsics camera = readCalibration(settings.onboard.camera);
    const FrameSize size{camera.width_px, camera.height_px, settings.onboard.halve};
    FrameInput input(settings.onboard, size, -1);
    if (input.isLost()) return report(false, "camera", path + ": see above");
    Frame frame;
    for (int tries = 0; tries < 20; ++tries) {
      if (!isReadable(input.descriptor(), 100)) continue;
      const FrameSource::Read read = input.read(frame);
      if (read == FrameSource::Read::kLost) return report(false, "camera", path + ": see above");
      if (read == FrameSource::Read::kFrame)
        return report(true, "camera", path + ": an image has come");
    }
    return report(false, "camera", path + ": no image within 2 s");
  } catch (const std::exception& e) {
    return report(false, "camera", e.what());
  }
}

}  // namespace

std::uint64_t kernelHash() {
  CameraIntrinsics camera;
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.fx_px = camera.fy_px = 350;
  camera.cx_px = kWidth_px / 2.0;
  camera.cy_px = kHeight_px / 2.0;
  TrackerConfig config;
  config.corners.features_per_frame = 150;
  Tracker tracker(config, camera);
  ImageFeatures features;
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (int image = 0; image < 2; ++image) {
    const std::vector<std::uint8_t> pixels = generatedPixels(3 * image, 2 * image);
    tracker.process({pixels.data(), kWidth_px, kHeight_px, kWidth_px}, image + 1, features);
    mix(hash, static_cast<std::uint32_t>(features.size()));
    for (std::size_t i = 0; i < features.size(); ++i) {
      mix(hash, static_cast<std::uint32_t>(features.pixel_px[i].x()));
      mix(hash, static_cast<std::uint32_t>(features.pixel_px[i].y()));
      mix(hash, features.score[i]);
      mix(hash, features.track_id[i]);
      for (const std::uint64_t word : features.descriptor[i].words) mix(hash, word);
    }
  }
  return hash;
}

bool selfTest(const Settings& settings) {
  bool is_good = testProcessor();
  is_good = testClock() && is_good;
  is_good = testKernels() && is_good;
  is_good = testMemory(settings) && is_good;
  is_good = testCamera(settings) && is_good;
  std::printf("%s\n", is_good ? "self-test passed" : "self-test failed");
  return is_good;
}

}  // namespace ardrone_vslam
