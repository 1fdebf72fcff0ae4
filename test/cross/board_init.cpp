// SPDX-License-Identifier: BSD-3-Clause
// The first and only process of the emulated board (scripts/emulated_board). It does what /plan
// says, a line each, and tells on the serial port what came of it; board_report reads that.
//   module FILE: load a kernel module
//   copy FILE OFFSET BYTES: write it from the card's bytes
//   run NAME LIMIT_MB IMAGE_BYTES close|term COMMAND...: run it in so much address space; that many
//     of the card's first bytes go to its standard input, which then ends, or it gets SIGTERM
//   send FILE: its bytes in hexadecimal digits, with their CRC-32
#include <fcntl.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/vslam_protocol.h"

namespace {

constexpr const char* kCard = "/dev/mmcblk0";

std::string readWhole(const std::string& path) {
  std::string text;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    std::printf("== fault %s: %s\n", path.c_str(), std::strerror(errno));
    return text;
  }
  std::array<char, 4096> part;
  for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), file)) > 0;)
    text.append(part.data(), n);
  std::fclose(file);
  return text;
}

/// The value of the first line "key ... : value" of a file in /proc.
std::string valueIn(const std::string& path, const std::string& key) {
  std::istringstream lines(readWhole(path));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (line.rfind(key, 0) == 0 && colon != std::string::npos)
      return line.substr(std::min(line.size(), line.find_first_not_of(" \t", colon + 1)));
  }
  return "unknown";
}

void loadModule(const std::string& path) {
  std::string bytes = readWhole(path);
  if (::syscall(SYS_init_module, bytes.data(), bytes.size(), "") != 0)
    std::printf("== fault %s: %s\n", path.c_str(), std::strerror(errno));
  constexpr int kTries = 100;  // the card is found some time later
  for (int i = 0; i < kTries && ::access(kCard, R_OK) != 0; ++i) ::usleep(100'000);
}

/// The card's first bytes, as fast as they are taken.
void feed(int to, long bytes) {
  const int card = bytes > 0 ? ::open(kCard, O_RDONLY) : -1;
  if (bytes > 0 && card < 0) std::printf("== fault %s: %s\n", kCard, std::strerror(errno));
  std::vector<char> part(65536);
  while (card >= 0 && bytes > 0) {
    const ssize_t got = ::read(card, part.data(), std::min<std::size_t>(part.size(), bytes));
    if (got <= 0) break;
    bytes -= got;
    ssize_t sent = 0;
    for (ssize_t n = 0; sent < got && n >= 0; sent += std::max<ssize_t>(n, 0))
      n = ::write(to, part.data() + sent, static_cast<std::size_t>(got - sent));
    if (sent < got) break;  // it has ended
  }
  if (card >= 0) ::close(card);
}

/// The flight's records are too long for what the kernel unpacks at its start.
void copy(const std::string& path, off_t offset, long bytes) {
  const int card = ::open(kCard, O_RDONLY);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  bool is_good = card >= 0 && file != nullptr && ::lseek(card, offset, SEEK_SET) == offset;
  std::vector<char> part(65536);
  while (is_good && bytes > 0) {
    const std::size_t wanted = std::min(part.size(), static_cast<std::size_t>(bytes));
    const ssize_t got = ::read(card, part.data(), wanted);
    is_good = got > 0 && std::fwrite(part.data(), 1, static_cast<std::size_t>(got), file) ==
                             static_cast<std::size_t>(got);
    bytes -= got;
  }
  if (file != nullptr) is_good = std::fclose(file) == 0 && is_good;
  if (card >= 0) ::close(card);
  if (!is_good) std::printf("== fault %s: %s\n", path.c_str(), std::strerror(errno));
}

[[noreturn]] void execute(const std::vector<std::string>& command, rlim_t limit_mb) {
  const rlimit limit{limit_mb << 20, limit_mb << 20};
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  if (::setrlimit(RLIMIT_AS, &limit) == 0) ::execv(arguments[0], arguments.data());
  std::printf("== fault %s: %s\n", arguments[0], std::strerror(errno));
  std::fflush(stdout);
  ::_exit(127);
}

void run(std::istringstream& words) {
  std::string name, end;
  rlim_t limit_mb = 0;
  long image_bytes = 0;
  words >> name >> limit_mb >> image_bytes >> end;
  std::vector<std::string> command;
  for (std::string word; words >> word;) command.push_back(word);
  std::printf("== run %s\n", name.c_str());
  std::fflush(stdout);
  int ends[2];
  if (command.empty() || ::pipe(ends) != 0) return;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    execute(command, limit_mb);
  }
  ::close(ends[0]);
  feed(ends[1], image_bytes);
  if (end == "term") ::kill(child, SIGTERM);
  if (end == "close") ::close(ends[1]);
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  if (end != "close") ::close(ends[1]);
  std::printf("== end %s exit %d signal %d maxrss_kb %ld user_us %lld system_us %lld\n",
              name.c_str(), WIFEXITED(status) ? WEXITSTATUS(status) : -1,
              WIFSIGNALED(status) ? WTERMSIG(status) : 0, usage.ru_maxrss,
              1000000LL * usage.ru_utime.tv_sec + usage.ru_utime.tv_usec,
              1000000LL * usage.ru_stime.tv_sec + usage.ru_stime.tv_usec);
}

void send(const std::string& path) {
  const std::string text = readWhole(path);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  std::printf("== file %s %zu %u\n", path.c_str(), text.size(), vslam_crc32(bytes, text.size()));
  constexpr std::size_t kPerLine = 100;
  for (std::size_t i = 0; i < text.size(); ++i)
    std::printf("%02x%s", bytes[i], i % kPerLine == kPerLine - 1 ? "\n" : "");
  std::printf("\n== file_end\n");
}

}  // namespace

int main() {
  for (const char* folder : {"/proc", "/dev", "/data"}) ::mkdir(folder, 0755);
  ::mount("proc", "/proc", "proc", 0, nullptr);
  ::mount("devtmpfs", "/dev", "devtmpfs", 0, nullptr);
  if (::mount("tmpfs", "/data", "tmpfs", 0, "size=64m") != 0)  // the first file system is smaller
    std::printf("== fault /data: %s\n", std::strerror(errno));
  ::signal(SIGPIPE, SIG_IGN);
  std::printf("== kernel %s", readWhole("/proc/version").c_str());
  std::printf("== processor %s\n", valueIn("/proc/cpuinfo", "model name").c_str());
  std::printf("== part %s\n", valueIn("/proc/cpuinfo", "CPU part").c_str());
  std::printf("== features %s\n", valueIn("/proc/cpuinfo", "Features").c_str());
  std::printf("== memory %s\n", valueIn("/proc/meminfo", "MemTotal").c_str());
  std::istringstream plan(readWhole("/plan"));
  for (std::string line; std::getline(plan, line);) {
    std::istringstream words(line);
    std::string what, path;
    words >> what;
    if (what == "run") run(words);
    if (what == "module" && words >> path) loadModule(path);
    off_t offset = 0;
    long bytes = 0;
    if (what == "copy" && words >> path >> offset >> bytes) copy(path, offset, bytes);
    if (what == "send" && words >> path) send(path);
    std::fflush(stdout);
  }
  std::printf("== done\n");
  std::fflush(stdout);
  ::sync();
  ::sleep(1);  // the serial port's last bytes
  ::reboot(RB_AUTOBOOT);
}
