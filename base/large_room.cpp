#include "base/large_room.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace barkridge {

namespace {

// Less is not worth a call to the system; more deserves large pages, of 2 MiB as a rule.
constexpr std::size_t kFew = std::size_t{1} << 17;
constexpr std::size_t kMany = std::size_t{1} << 22;

}  // namespace

void ready_pages(const void* start, std::size_t bytes) {
  if (bytes < kFew) return;
  // Whole pages; that neighbours in memory share the first and the last does them no harm.
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(start);
  const std::uintptr_t first = address / page * page;
  // Systems that cannot do it refuse, and nothing is lost.
  (void)::madvise(reinterpret_cast<void*>(first), address + bytes - first,
                  bytes < kMany ? MADV_POPULATE_WRITE : MADV_HUGEPAGE);
}

}  // namespace barkridge
