// SPDX-License-Identifier: BSD-3-Clause
#include "loop/stop_signal.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace ardrone_vslam {
namespace {

int write_end = -1;

void onSignal(int /*signal*/) {
  const int kept = errno;
  const char byte = 0;
  if (::write(write_end, &byte, 1) < 0) errno = kept;  // full: it is readable already
  errno = kept;
}

}  // namespace

int installStopSignal() {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe for signals");
  write_end = ends[1];
  ::fcntl(write_end, F_SETFL, O_NONBLOCK);
  struct sigaction action {};
  action.sa_handler = onSignal;
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGINT, &action, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
  return ends[0];
}

}  // namespace ardrone_vslam
