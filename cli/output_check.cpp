#include "cli/output_check.h"

#include "base/output_file.h"

namespace barkridge::cli {

void check_writable(const std::string& path) { const OutputFile never_committed(path); }

}  // namespace barkridge::cli
