// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <string>

namespace ardrone_vslam::test {

constexpr int kNoDisk = 77;  ///< exit code: this system lets nobody mount one

/// Gives this process a file system of its own at the folder, in memory, of so many bytes. Nobody
/// else sees it, and it goes with the process. Needs no rights where user namespaces are allowed.
inline bool mountSmallDisk(const std::string& folder, int bytes) {
  const uid_t user = ::geteuid();
  const gid_t group = ::getegid();
  if (::unshare(CLONE_NEWNS) != 0) {
    if (::unshare(CLONE_NEWNS | CLONE_NEWUSER) != 0) return false;
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
  }
  const std::string options = "size=" + std::to_string(bytes);
  return ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) == 0;
}

/// Runs it in a process with a small disk. @return what it returned, kNoDisk, or -1 if it fell over
/// or threw
inline int onSmallDisk(const std::string& folder, int bytes, const std::function<int()>& run) {
  const pid_t process = ::fork();
  if (process == 0) {
    try {
      ::_exit(mountSmallDisk(folder, bytes) ? run() : kNoDisk);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "on the small disk: %s\n", e.what());
      std::abort();
    }
  }
  int status = 0;
  if (::waitpid(process, &status, 0) != process || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

}  // namespace ardrone_vslam::test
