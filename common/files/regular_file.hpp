// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "files/plain_text.hpp"

namespace ardrone_vslam {

constexpr std::uintmax_t kLargestYaml_bytes = 1'000'000;         ///< configuration, calibration
constexpr std::uintmax_t kLargestImage_bytes = 256'000'000;      ///< an encoded one
constexpr std::uintmax_t kLargestTable_bytes = 1'000'000'000;    ///< poses, stamps, ranges
constexpr std::uintmax_t kLargestStream_bytes = 16'000'000'000;  ///< a video

/// What keeps a path from being read as a file: a pipe or a device may never end. Empty when there
/// is nothing at the path: who opens it says so.
inline std::string faultOfFile(const std::string& path, std::uintmax_t most_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status)) return "";
  if (!std::filesystem::is_regular_file(status))
    return "is no file but a folder, device or pipe; name a file";
  if (std::filesystem::file_size(path, error) > most_bytes)
    return "is larger than " + std::to_string(most_bytes / 1'000'000) +
           " MB, which no such file is; check the path";
  return "";
}

/// @throws std::runtime_error with the faultOfFile
inline void requireFile(const std::string& path, std::uintmax_t most_bytes) {
  const std::string fault = faultOfFile(path, most_bytes);
  if (!fault.empty()) throw std::runtime_error(path + ": " + fault);
}

/// @param advice  what to do when it cannot be read
/// @throws std::runtime_error with the faultOfFile, or when it cannot be read
inline std::ifstream openFile(const std::string& path, std::uintmax_t most_bytes,
                              const std::string& advice = "check the path") {
  requireFile(path, most_bytes);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read; " + advice);
  return file;
}

/// A configuration's or calibration's text.
/// @throws std::runtime_error as openFile, or with the faultOfText
inline std::string readYamlText(const std::string& path,
                                const std::string& advice = "check the path") {
  std::ifstream file = openFile(path, kLargestYaml_bytes, advice);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string fault = faultOfText(text);
  if (!fault.empty()) throw std::runtime_error(path + ": " + fault);
  return text;
}

}  // namespace ardrone_vslam
