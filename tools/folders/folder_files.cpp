// SPDX-License-Identifier: BSD-3-Clause
#include "folders/folder_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "files/regular_file.hpp"
#include "files/shortened.hpp"

namespace ardrone_vslam {
namespace {

namespace fs = std::filesystem;

bool isImageFile(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".pgm";
}

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// 2.png comes before 10.png, which the order of characters would turn round.
bool isBefore(const std::string& a, const std::string& b) {
  const std::string stem_a = fs::path(a).stem().string();
  const std::string stem_b = fs::path(b).stem().string();
  if (!isNumber(stem_a) || !isNumber(stem_b)) return a < b;
  const auto significant = [](const std::string& digits) {
    return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  };
  const std::string digits_a = significant(stem_a);
  const std::string digits_b = significant(stem_b);
  if (digits_a.size() != digits_b.size()) return digits_a.size() < digits_b.size();
  return digits_a != digits_b ? digits_a < digits_b : a < b;
}

}  // namespace

std::vector<std::string> listImages(const std::string& folder) {
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(folder + ": there is no such folder; it must hold the images");
  }
  std::vector<std::string> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (isImageFile(entry.path())) images.push_back(entry.path().string());
  }
  if (images.empty()) {
    throw std::runtime_error(folder + ": holds no png, jpg or pgm image; put the images there");
  }
  std::sort(images.begin(), images.end(), isBefore);
  return images;
}

std::vector<long double> parseNumbers(const std::string& line, const std::string& path,
                                      std::size_t line_number) {
  std::vector<long double> numbers;
  std::istringstream words(line);
  std::string word;
  while (words >> word) {
    char* end = nullptr;
    numbers.push_back(std::strtold(word.c_str(), &end));
    if (end != word.c_str() + word.size()) {
      throw std::runtime_error(path + ", line " + std::to_string(line_number) + ": '" +
                               shortened(word) + "' is not a number");
    }
  }
  return numbers;
}

std::vector<std::int64_t> readImageStamps(const std::string& path, std::size_t image_count) {
  std::ifstream file = openFile(path, kLargestTable_bytes,
                                "write one stamp in seconds a line, in the order of the images");
  std::vector<std::int64_t> stamps_ns;
  std::string line;
  for (std::size_t line_number = 1; std::getline(file, line); ++line_number) {
    if (!line.empty() && line[0] == '#') continue;
    const auto numbers = parseNumbers(line, path, line_number);
    if (numbers.empty()) continue;
    const std::string place = path + ", line " + std::to_string(line_number) + ": ";
    // Beyond 9e9 s (the year 2255) the nanoseconds would leave their 64 bits.
    if (!std::isfinite(numbers[0]) || std::abs(numbers[0]) > 9e9L) {
      throw std::runtime_error(place + "the stamp is not a finite number of seconds; correct it");
    }
    stamps_ns.push_back(std::llround(numbers[0] * 1e9L));
    if (stamps_ns.size() > 1 && stamps_ns.back() <= stamps_ns[stamps_ns.size() - 2]) {
      throw std::runtime_error(
          place + "the stamp is not later than the one before; stamps must ascend with the images");
    }
  }
  if (stamps_ns.size() != image_count) {
    throw std::runtime_error(path + ": has " + std::to_string(stamps_ns.size()) + " stamps for " +
                             std::to_string(image_count) +
                             " images; give one stamp for each image");
  }
  return stamps_ns;
}

}  // namespace ardrone_vslam
