// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/text_file.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ardrone_vslam {

void writeText(const std::string& path, const std::string& text) {
  std::error_code error;
  // What is there and no file, a device say, is written to as it is.
  const bool is_file =
      !std::filesystem::exists(path, error) || std::filesystem::is_regular_file(path, error);
  // Through links to the file itself, which they go on naming.
  const std::string file = std::filesystem::weakly_canonical(path, error).string();
  const std::string target = error || file.empty() ? path : file;
  const std::string written = is_file ? target + ".part" : path;
  std::ofstream out(written);
  out << text;
  out.close();
  bool is_written = static_cast<bool>(out);
  if (is_file && is_written) {
    std::filesystem::rename(written, target, error);
    is_written = !error;
  }
  if (is_file && !is_written) std::filesystem::remove(written, error);
  if (!is_written)
    throw std::runtime_error(
        path + ": cannot be written; check that the folder exists and the disk has room");
}

}  // namespace ardrone_vslam
