#pragma once

#include <numbers>

namespace barkridge::test {

inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace barkridge::test
