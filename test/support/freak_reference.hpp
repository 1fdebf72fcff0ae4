// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "freak/freak.hpp"

namespace ardrone_vslam::test {

/// One row of a table of reference descriptors; its columns are explained in
/// test/data/freak/README.md.
struct FreakRow {
  std::string image, mode;
  FreakKeypoint keypoint;
  std::string angle_deg;  ///< as printed, four decimals
  std::string descriptor_hex;
};

/// @return all rows below the heading; empty when the file cannot be read
inline std::vector<FreakRow> readFreakRows(const std::string& path) {
  std::vector<FreakRow> rows;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string x, y, size;
    FreakRow row;
    for (std::string* cell :
         {&row.image, &row.mode, &x, &y, &size, &row.angle_deg, &row.descriptor_hex}) {
      std::getline(cells, *cell, ',');
    }
    row.keypoint = {static_cast<int>(std::stod(x)), static_cast<int>(std::stod(y)),
                    std::stof(size)};
    rows.push_back(row);
  }
  return rows;
}

inline std::string hexOf(const Descriptor& descriptor) {
  std::string hex;
  char text[3];
  for (const std::uint64_t word : descriptor.words) {
    for (int byte = 0; byte < 8; ++byte) {
      std::snprintf(text, sizeof(text), "%02x",
                    static_cast<unsigned>((word >> (8 * byte)) & 0xffU));
      hex += text;
    }
  }
  return hex;
}

inline std::string printedAngle(float angle_deg) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4f", static_cast<double>(angle_deg));
  return text;
}

/// Describes the keypoints of the rows of one image and one mode in a single call.
/// @param set  the kernels to be used
/// @return one sentence for each row whose descriptor or angle is not exactly the row's
inline std::vector<std::string> differencesFrom(const std::vector<FreakRow>& rows,
                                                const ImageView& image, InstructionSet set) {
  std::vector<std::string> differences;
  if (rows.empty()) return differences;
  FreakDescriber describer(FreakConfig{rows.front().mode != "upright"}, set);
  std::vector<FreakKeypoint> keypoints;
  for (const FreakRow& row : rows) keypoints.push_back(row.keypoint);
  std::vector<int> kept;
  std::vector<Descriptor> descriptors;
  std::vector<float> angles_deg;
  describer.describe(image, keypoints, kept, descriptors, &angles_deg);
  if (kept.size() != rows.size())
    differences.push_back("keypoints were dropped that the reference has");
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const FreakRow& row = rows[static_cast<std::size_t>(kept[k])];
    if (hexOf(descriptors[k]) == row.descriptor_hex && printedAngle(angles_deg[k]) == row.angle_deg)
      continue;
    differences.push_back(row.image + " " + row.mode + " " + nameOf(set) + " keypoint (" +
                          std::to_string(row.keypoint.x_px) + ", " +
                          std::to_string(row.keypoint.y_px) + "): angle " +
                          printedAngle(angles_deg[k]) + " for " + row.angle_deg + ", descriptor " +
                          hexOf(descriptors[k]) + " for " + row.descriptor_hex);
  }
  return differences;
}

/// @return the rows of one image and mode, in their order
inline std::vector<FreakRow> rowsOf(const std::vector<FreakRow>& rows, const std::string& image,
                                    const std::string& mode) {
  std::vector<FreakRow> chosen;
  for (const FreakRow& row : rows) {
    if (row.image == image && row.mode == mode) chosen.push_back(row);
  }
  return chosen;
}

}  // namespace ardrone_vslam::test
