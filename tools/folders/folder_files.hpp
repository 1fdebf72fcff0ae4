// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// The image files of a folder (png, jpg, jpeg, pgm) in the order of their names; names that are
/// numbers are ordered as numbers.
/// @throws std::runtime_error naming the folder when it is missing or holds no image
std::vector<std::string> listImages(const std::string& folder);

/// The numbers of one line. @throws std::runtime_error naming file and line when a word is none
std::vector<long double> parseNumbers(const std::string& line, const std::string& path,
                                      std::size_t line_number);

/// times.txt: a stamp in seconds a line, strictly ascending, one for each image.
/// @throws std::runtime_error naming the file, the line, the fault and the remedy
std::vector<std::int64_t> readImageStamps(const std::string& path, std::size_t image_count);

}  // namespace ardrone_vslam
