#pragma once
// Room in memory for much at once. The first touch of every small page stops the program for longer than it takes to
// fill that page; large pages are touched hundreds of times less often.

#include <cstddef>

namespace barkridge {

/// Asks the system to make the memory from `start` on of large pages, where it has them. Changes nothing but the time
/// that the first touch takes.
void prefer_large_pages(const void* start, std::size_t bytes);

/// Reserves room for `count` elements of a vector or string that are about to be added.
template <typename Container>
void reserve_large(Container& container, std::size_t count) {
  container.reserve(count);
  prefer_large_pages(container.data(), container.capacity() * sizeof(*container.data()));
}

/// Gives an empty vector `count` elements of the value that is the default.
template <typename Container>
void resize_large(Container& container, std::size_t count) {
  reserve_large(container, count);
  container.resize(count);
}

}  // namespace barkridge
