#include "tests/cli/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

namespace {

struct Pipe {
  int read_end = -1, write_end = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    read_end = ends[0];
    write_end = ends[1];
  }
};

[[noreturn]] void become_program(const std::vector<std::string>& arguments) {
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  std::vector<char*> argv = {const_cast<char*>("barkridge")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(BARKRIDGE_PROGRAM, argv.data());
  ::_exit(127);
}

// Feeds and drains all pipes at once, so that none of them fills up and stops the program.
void communicate(int input_pipe, const std::string& input, const std::array<int, 2>& output_pipes,
                 const std::array<std::string*, 2>& outputs) {
  std::size_t fed = 0;
  std::array<pollfd, 3> polled = {pollfd{output_pipes[0], POLLIN, 0}, pollfd{output_pipes[1], POLLIN, 0},
                                  pollfd{input_pipe, POLLOUT, 0}};
  while (polled[0].fd >= 0 || polled[1].fd >= 0) {
    if (fed == input.size() && polled[2].fd >= 0) {
      ::close(input_pipe);
      polled[2].fd = -1;
    }
    ::poll(polled.data(), polled.size(), -1);
    for (std::size_t i = 0; i < 2; ++i) {
      if (polled[i].fd < 0 || polled[i].revents == 0) continue;
      char chunk[65536];
      const ssize_t size = ::read(polled[i].fd, chunk, sizeof chunk);
      if (size > 0) {
        outputs[i]->append(chunk, static_cast<std::size_t>(size));
      } else {
        polled[i].fd = -1;
      }
    }
    if (polled[2].fd >= 0 && polled[2].revents != 0) {
      const ssize_t size = ::write(input_pipe, input.data() + fed, input.size() - fed);
      fed = size > 0 ? fed + static_cast<std::size_t>(size) : input.size();
    }
  }
  if (polled[2].fd >= 0) ::close(input_pipe);
}

Finished finish(pid_t child, Finished finished) {
  finished.status = wait_for(child);
  return finished;
}

}  // namespace

int wait_for(int process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int start_program(const std::vector<std::string>& arguments) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (int descriptor = 0; descriptor <= 2; ++descriptor) ::dup2(nowhere, descriptor);
    become_program(arguments);
  }
  return child;
}

Finished run_program(const std::vector<std::string>& arguments, const RunOptions& options) {
  std::signal(SIGPIPE, SIG_IGN);
  const Pipe in, out, err;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(in.read_end, 0);
    ::dup2(out.write_end, 1);
    ::dup2(err.write_end, 2);
    if (options.before_start) options.before_start();
    become_program(arguments);
  }
  ::close(in.read_end);
  ::close(out.write_end);
  ::close(err.write_end);
  Finished finished;
  communicate(in.write_end, options.input, {out.read_end, err.read_end}, {&finished.out, &finished.err});
  ::close(out.read_end);
  ::close(err.read_end);
  return finish(child, finished);
}

bool has_terminals() {
  int controller = -1, terminal = -1;
  if (::openpty(&controller, &terminal, nullptr, nullptr, nullptr) != 0) return false;
  ::close(controller);
  ::close(terminal);
  return true;
}

Finished run_program_on_terminal(const std::vector<std::string>& arguments) {
  int controller = -1, terminal = -1;
  if (::openpty(&controller, &terminal, nullptr, nullptr, nullptr) != 0) throw std::runtime_error("openpty");
  const Pipe out;
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(controller);
    ::dup2(out.write_end, 1);
    ::dup2(terminal, 2);
    become_program(arguments);
  }
  ::close(terminal);
  ::close(out.write_end);
  Finished finished;
  communicate(-1, "", {out.read_end, controller}, {&finished.out, &finished.err});
  ::close(out.read_end);
  ::close(controller);
  return finish(child, finished);
}
