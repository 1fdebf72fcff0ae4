// SPDX-License-Identifier: BSD-3-Clause
// Loaded before the nodelet manager (LD_PRELOAD): counts how often code of this package, including
// what Boost and roscpp inline into it, locks a mutex, and how often it has to wait for another
// thread. The counts are in the file that ARDRONE_VSLAM_LOCK_REPORT names, as struct Report.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

struct Report {
  std::atomic<std::int64_t> locks;
  std::atomic<std::int64_t> waits;
  std::atomic<std::int64_t> longest_ns;
};

Report* openReport() {
  const char* path = std::getenv("ARDRONE_VSLAM_LOCK_REPORT");
  if (path == nullptr) return nullptr;
  const int file = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0 || ftruncate(file, sizeof(Report)) != 0) std::abort();
  void* memory = mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory == MAP_FAILED) std::abort();
  return static_cast<Report*>(memory);
}

Report* const report = openReport();

bool isOurs(const void* code) {
  Dl_info info;
  return dladdr(code, &info) != 0 && std::strstr(info.dli_fname, "libardrone_vslam") != nullptr;
}

int lockNow(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  return lock(mutex);
}

int lockAndMeasure(pthread_mutex_t* mutex) {
  ++report->waits;
  const auto begin = std::chrono::steady_clock::now();
  const int result = lockNow(mutex);
  const std::int64_t passed_ns = (std::chrono::steady_clock::now() - begin).count();
  std::int64_t longest_ns = report->longest_ns;
  while (passed_ns > longest_ns &&
         !report->longest_ns.compare_exchange_weak(longest_ns, passed_ns)) {
  }
  return result;
}

}  // namespace

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
  if (report == nullptr || !isOurs(__builtin_return_address(0))) return lockNow(mutex);
  ++report->locks;
  return pthread_mutex_trylock(mutex) == 0 ? 0 : lockAndMeasure(mutex);
}
