// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_page.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace ardrone_vslam {

std::string findEvaluateScript() {
  namespace fs = std::filesystem;
  std::error_code error;  // without /proc only the source folder is left
  const fs::path program_folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::string searched;
  for (const fs::path& folder :
       {program_folder, fs::path(ARDRONE_VSLAM_SOURCE_CONFIG).parent_path() / "scripts"}) {
    const fs::path candidate = folder / "evaluate";
    if (fs::is_regular_file(candidate, error)) return candidate.string();
    searched += (searched.empty() ? "" : " and ") + folder.string();
  }
  throw std::runtime_error(
      "the package's script evaluate, which writes the report, was not found in " + searched +
      "; install the package again, or leave out --report");
}

void writeRunPage(const std::string& script, const std::string& folder) {
  std::cout.flush();
  const std::string run = std::filesystem::absolute(folder).string();  // "-x" would be an option
  std::string program = script;
  std::string argument = run;
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int fault =
      posix_spawn(&child, script.c_str(), nullptr, nullptr, arguments.data(), environ);
  if (fault != 0) {
    throw std::runtime_error(script + ": cannot be run (" + std::strerror(fault) +
                             "); the report needs /usr/bin/python3 with Debian's python3-numpy and "
                             "python3-matplotlib: run scripts/install_dependencies");
  }
  int status = 0;
  while (waitpid(child, &status, 0) == -1 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("no report: " + script + " " + run +
                             " failed, its message is above; the run itself is written");
  }
}

}  // namespace ardrone_vslam
