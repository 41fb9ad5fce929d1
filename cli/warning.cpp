#include "cli/warning.h"

#include <iostream>

#include "cli/progress_bar.h"

namespace barkridge::cli {

void warn(const std::string& message) {
  clear_progress_line();
  std::cerr << "barkridge: warning: " + message + '\n';
}

}  // namespace barkridge::cli
