#pragma once
// Room in memory for much at once. The first touch of every page stops the program, for longer than it takes to fill a
// small page; that is most of the time of work that goes through much memory once.

#include <cstddef>

namespace barkridge {

/// Readies memory that is about to be filled: asks the system for large pages, which are touched hundreds of times less
/// often, or for all pages in one go where they would be few. Changes nothing but the time that the first touch takes.
void ready_pages(const void* start, std::size_t bytes);

/// Reserves room for the `count` elements that a vector or string is about to get.
template <typename Container>
void reserve_large(Container& container, std::size_t count) {
  container.reserve(count);
  ready_pages(container.data(), container.capacity() * sizeof(*container.data()));
}

/// Gives an empty vector `count` default elements.
template <typename Container>
void resize_large(Container& container, std::size_t count) {
  reserve_large(container, count);
  container.resize(count);
}

}  // namespace barkridge
