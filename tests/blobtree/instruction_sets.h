#pragma once
// Tests on each instruction set of this machine.

#include <hwy/targets.h>

#include <catch2/catch.hpp>

namespace barkridge::test {

/// Runs `check` once for each instruction set of this machine, and tells how many there are.
template <typename Check>
int on_every_instruction_set(Check check) {
  int sets = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    CAPTURE(hwy::TargetName(target));
    check();
    ++sets;
  }
  hwy::SetSupportedTargetsForTest(0);
  return sets;
}

}  // namespace barkridge::test
