#include "base/large_room.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

using namespace barkridge;

TEST_CASE("room of any size is reserved once and holds what it is given") {
  for (const std::size_t count : {0u, 1u, 1000u, 100000u, 3000000u}) {
    std::vector<std::uint32_t> numbers;
    resize_large(numbers, count);
    CHECK(numbers.size() == count);
    CHECK(numbers.capacity() == count);
    CHECK(std::all_of(numbers.begin(), numbers.end(), [](std::uint32_t number) { return number == 0; }));
    std::string text;
    reserve_large(text, count);
    const char* const start = text.data();
    text.append(count, 'x');
    CHECK(text.data() == start);
    CHECK(text == std::string(count, 'x'));
  }
}
