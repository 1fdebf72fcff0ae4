// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/text_file.hpp"

#include <fstream>
#include <stdexcept>

namespace ardrone_vslam {

void writeText(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out)
    throw std::runtime_error(
        path + ": cannot be written; check that the folder exists and the disk has room");
}

}  // namespace ardrone_vslam
