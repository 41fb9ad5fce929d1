#include "lsystem/program.h"

#include <algorithm>
#include <array>

namespace barkridge {

namespace {

constexpr std::array<FunctionInfo, 23> kFunctions{{
    {"sin", 1, Op::kSin},
    {"cos", 1, Op::kCos},
    {"tan", 1, Op::kTan},
    {"asin", 1, Op::kAsin},
    {"acos", 1, Op::kAcos},
    {"atan", 1, Op::kAtan},
    {"exp", 1, Op::kExp},
    {"log", 1, Op::kLog},
    {"floor", 1, Op::kFloor},
    {"ceil", 1, Op::kCeil},
    {"sqrt", 1, Op::kSqrt},
    {"fabs", 1, Op::kFabs},
    {"sign", 1, Op::kSign},
    {"trunc", 1, Op::kRound},  // cpfg's trunc rounds
    {"ran", 1, Op::kRan},
    {"nran", 2, Op::kNran},
    {"bran", 2, Op::kBran},
    {"biran", 2, Op::kBiran},
    {"srand", 1, Op::kSrand},
    {"stop", 1, Op::kStop},
    {"GetDerivationLength", 1, Op::kGetDerivationLength},
    {"SetDerivationLength", 1, Op::kSetDerivationLength},
    {"GetTime", 1, Op::kGetTime},
}};

}  // namespace

int stack_effect(Op op) {
  switch (op) {
    case Op::kConstant:
    case Op::kLoad:
    case Op::kLoadElement:
    case Op::kPrintf:
      return 1;
    case Op::kStore:
    case Op::kStoreElement:
    case Op::kPop:
    case Op::kJumpIfZero:
    case Op::kAndJump:
    case Op::kOrJump:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kDivide:
    case Op::kRemainder:
    case Op::kPower:
    case Op::kEqual:
    case Op::kNotEqual:
    case Op::kLess:
    case Op::kLessEqual:
    case Op::kGreater:
    case Op::kGreaterEqual:
    case Op::kNran:
    case Op::kBran:
    case Op::kBiran:
      return -1;
    default:
      return 0;
  }
}

std::uint32_t first_place(const Program& program) {
  const auto earlier = [](const Instruction& a, const Instruction& b) { return a.place < b.place; };
  return std::min_element(program.begin(), program.end(), earlier)->place;
}

void append_program(Program& program, const Program& tail) {
  const auto base = static_cast<std::uint32_t>(program.size());
  for (Instruction instruction : tail) {
    const Op op = instruction.op;
    if (op == Op::kJump || op == Op::kJumpIfZero || op == Op::kAndJump || op == Op::kOrJump) {
      instruction.operand += base;
    }
    program.push_back(instruction);
  }
}

const FunctionInfo* find_function(std::string_view name) {
  const auto found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                  [&](const FunctionInfo& function) { return function.name == name; });
  return found == kFunctions.end() ? nullptr : found;
}

}  // namespace barkridge
