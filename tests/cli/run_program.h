#pragma once
// The built program, run as a user runs it.

#include <functional>
#include <string>
#include <vector>

struct Finished {
  int status = -1;  ///< what the program exited with; -signal if a signal killed it
  std::string out, err;
};

struct RunOptions {
  std::string input;  ///< the standard input
  /// Done in the child before the program starts: limits, redirections.
  std::function<void()> before_start;
};

/// Runs `barkridge ARGUMENTS...` to its end.
Finished run_program(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Whether this machine gives out pseudo-terminals; some containers do not.
bool has_terminals();

/// Runs it with the standard error on a pseudo terminal, which `err` then is what was written to.
Finished run_program_on_terminal(const std::vector<std::string>& arguments);

/// Starts it and gives its process id, output discarded; for tests that send signals. `wait_for` gives the status as in
/// `Finished`.
int start_program(const std::vector<std::string>& arguments);
int wait_for(int process);
