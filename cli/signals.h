#pragma once

namespace barkridge::cli {

/// Prepares the process for what may come from outside: SIGINT, SIGTERM and SIGHUP end it at once with status 128 +
/// signal, all unfinished outputs removed; writing to a closed pipe is an error and not a signal; descriptors 0 to 2
/// are open, so that no output file is taken for one of them.
void prepare_process();

}  // namespace barkridge::cli
