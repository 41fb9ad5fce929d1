#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lsystem/grammar_definition.h"
#include "lsystem/notify.h"
#include "lsystem/program.h"
#include "lsystem/random_streams.h"

namespace barkridge {

/// Everything that an L-system's statements can change.
struct MachineState {
  std::vector<double> slots;
  RandomStreams random;
  int derivation_length = 0;
  double time = 0;       ///< what the word is derived for, in steps
  bool stopped = false;  ///< `stop(x)` was called with x other than 1
};

/// Runs the programs of one L-system, in double precision.
class Machine {
 public:
  /// All variables 0 but the derivation length; the random streams as cpfg has them at its start.
  Machine(const GrammarDefinition& grammar, Notify listener);
  Machine(const GrammarDefinition& grammar, Notify listener, MachineState state);

  /// The number that the program leaves, or 0. Throws `LimitError` when loops go on for too long.
  double run(const Program& program) {
    // Most expressions are a single constant or variable.
    if (program.size() == 1 && program[0].op == Op::kLoad) return state.slots[program[0].operand];
    if (program.size() == 1 && program[0].op == Op::kConstant) return program[0].constant;
    return run_instructions(program);
  }
  /// The same for a module's parameter. Throws `InputError` if it is not a finite float.
  float run_parameter(const Program& program) {
    const double value = run(program);
    const float stored = static_cast<float>(value);
    if (!(stored - stored == 0)) refuse_parameter(program, value);
    return stored;
  }

  /// Tells the listener, once for each place and message.
  void warn(std::uint32_t place, const std::string& message);

  MachineState state;

 private:
  double run_instructions(const Program& program);
  [[noreturn]] void refuse_parameter(const Program& program, double value) const;
  double remainder(double a, double b, std::uint32_t place);
  std::size_t element_slot(const Instruction& instruction, const double* indices);
  void print(const Instruction& instruction, const double* values);
  [[noreturn]] void refuse_iteration(const Instruction& instruction) const;

  const GrammarDefinition& grammar_;
  Notify listener_;
  std::set<std::pair<std::uint32_t, std::string>> warned_;
};

/// What C's `printf` would write, each conversion taking one number. Values that are missing count as 0.
std::string format_printf(const std::string& format, const std::vector<double>& values);

}  // namespace barkridge
