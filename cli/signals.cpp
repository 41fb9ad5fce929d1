#include "cli/signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include "base/output_file.h"
#include "cli/progress_bar.h"

namespace barkridge::cli {

namespace {

extern "C" void end_by_signal(int signal) {
  clear_progress_line();
  remove_unfinished_outputs();
  ::_exit(128 + signal);
}

}  // namespace

void prepare_process() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    // Writing to a descriptor that was closed must stay an error, hence read-only.
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", O_RDONLY);
  }
  std::signal(SIGPIPE, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = end_by_signal;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited {};
    ::sigaction(signal, nullptr, &inherited);
    const bool nohup = signal == SIGHUP && inherited.sa_handler == SIG_IGN;
    if (!nohup) ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace barkridge::cli
