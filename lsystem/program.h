#pragma once
// Expressions and statements of an L-system, compiled for a stack machine (machine.h runs them).

#include <cstdint>
#include <string_view>
#include <vector>

namespace barkridge {

/// What one instruction does to the stack of numbers. `a`, `b` are the topmost numbers, `b` on top; results replace
/// them.
enum class Op : std::uint8_t {
  kConstant,      // push `constant`
  kLoad,          // push the variable in slot `operand`
  kStore,         // pop into slot `operand`
  kLoadElement,   // pop the indices, push the element of array `operand`
  kStoreElement,  // pop the indices, then the value
  kPop,
  kJump,            // to instruction `operand`
  kJumpIfZero,      // pop; jump if it was 0
  kAndJump,         // if a is 0, leave 0 and jump; else pop
  kOrJump,          // if a is not 0, leave 1 and jump; else pop
  kToTruth,         // a != 0
  kCountIteration,  // stops endless loops
  kNegate,
  kNot,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kRemainder,
  kPower,
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kExp,
  kLog,
  kFloor,
  kCeil,
  kSqrt,
  kFabs,
  kSign,
  kRound,
  kRan,
  kNran,
  kBran,
  kBiran,
  kSrand,
  kPrintf,  // `operand` = index of the format among the strings * 256 + number of values on the stack
  kStop,
  kGetDerivationLength,
  kSetDerivationLength,
  kGetTime,
};

struct Instruction {
  Op op;
  std::uint32_t place;  ///< offset in the preprocessed text, for messages
  union {
    double constant;
    std::uint32_t operand;
  };
};

/// Runs from the first instruction to past the last and leaves at most one number. An empty program stands for 0.
using Program = std::vector<Instruction>;

/// The deepest stack that a program may need; the compiler refuses more.
inline constexpr int kMaxStack = 256;

/// How the stack's height changes, apart from the indices and values that kLoadElement, kStoreElement and kPrintf take.
int stack_effect(Op op);

/// The place where the text of a program that is not empty begins.
std::uint32_t first_place(const Program& program);

/// Appends a program, moving its jumps.
void append_program(Program& program, const Program& tail);

struct FunctionInfo {
  std::string_view name;
  int argument_count;
  Op op;
};
/// The function that expressions call by this name, or nullptr. `printf`, which takes any number, is not among them.
const FunctionInfo* find_function(std::string_view name);

}  // namespace barkridge
