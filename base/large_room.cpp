#include "base/large_room.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace barkridge {

void prefer_large_pages(const void* start, std::size_t bytes) {
  constexpr std::size_t kWorthwhile = std::size_t{1} << 20;
  if (bytes < kWorthwhile) return;
  // The advice is for whole pages; that neighbours share the first and the last does them no harm.
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(start);
  const std::uintptr_t first = address / page * page;
  // Systems without large pages refuse; then the pages are small.
  (void)::madvise(reinterpret_cast<void*>(first), address + bytes - first, MADV_HUGEPAGE);
}

}  // namespace barkridge
