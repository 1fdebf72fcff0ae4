// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace ardrone_vslam {

/// Keeps what is in a file, if there is one, as `path`.before, in place of what that had. The file
/// stays as it is. By a hard link, or a copy where the disk has none.
/// @return why it cannot be kept; empty when it is, or there is no file
inline std::string setAside(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string before = path + ".before", link = before + ".part";
  std::error_code error;
  if (!fs::exists(path, error)) return "";
  fs::remove(link, error);
  fs::create_hard_link(path, link, error);
  if (error) fs::copy_file(path, link, fs::copy_options::overwrite_existing, error);
  if (!error) fs::rename(link, before, error);
  if (!error) return "";
  return path + ": what it has cannot be kept as " + before + " (" + error.message() +
         "), so nothing is written; make room there, or name another file";
}

}  // namespace ardrone_vslam
