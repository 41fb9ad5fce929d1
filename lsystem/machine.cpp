#include "lsystem/machine.h"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"

namespace barkridge {

namespace {

// Of one block's loops; about a second.
constexpr std::uint64_t kMaxIterations = 100'000'000;
constexpr std::size_t kMaxWarnings = 1000;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

// C's conversion, with a defined result for numbers out of range.
template <typename Integer>
Integer to_integer(double x) {
  if (!(x > static_cast<double>(std::numeric_limits<Integer>::min()))) {
    return std::isnan(x) ? 0 : std::numeric_limits<Integer>::min();
  }
  if (x >= static_cast<double>(std::numeric_limits<Integer>::max())) return std::numeric_limits<Integer>::max();
  return static_cast<Integer>(x);
}

}  // namespace

Machine::Machine(const GrammarDefinition& grammar, Notify listener)
    : Machine(grammar, std::move(listener), MachineState{}) {
  state.derivation_length = grammar.derivation_length;
  state.time = grammar.derivation_length;
  state.slots.resize(grammar.slot_count);
  state.slots[kLengthSlot] = grammar.derivation_length;
  if (grammar.seed) state.random.seed_choice(*grammar.seed);
}

Machine::Machine(const GrammarDefinition& grammar, Notify listener, MachineState initial)
    : state(std::move(initial)), grammar_(grammar), listener_(std::move(listener)) {}

void Machine::warn(std::uint32_t place, const std::string& message) {
  if (!listener_ || warned_.size() > kMaxWarnings) return;
  if (warned_.emplace(place, message).second) listener_(message_at(grammar_.source.place(place), message));
}

void Machine::refuse_parameter(const Program& program, double value) const {
  const std::uint32_t place = first_place(program);
  if (std::isfinite(value)) {
    throw InputError(grammar_.source.place(place),
                     fmt::format("this parameter is {:g}, too large for a module", value));
  }
  throw InputError(grammar_.source.place(place),
                   std::isnan(value) ? "this parameter is not a number (nan)" : "this parameter is infinite");
}

double Machine::remainder(double a, double b, std::uint32_t place) {
  const auto divisor = to_integer<std::int32_t>(b);
  if (divisor == 0) warn(place, "remainder of a division by 0; it is taken as 0");
  if (divisor == 0 || divisor == -1) return 0;
  return to_integer<std::int32_t>(a) % divisor;
}

std::size_t Machine::element_slot(const Instruction& instruction, const double* indices) {
  const ArrayVariable& array = grammar_.arrays[instruction.operand];
  std::size_t offset = 0;
  for (std::size_t i = 0; i < array.sizes.size(); ++i) {
    double index = indices[i];
    const std::uint32_t size = array.sizes[i];
    if (!(index >= 0 && index < size)) {
      const double clamped = index >= size ? size - 1.0 : 0.0;
      warn(instruction.place,
           fmt::format("index {} of array `{}` is out of range; the nearest is used", i + 1, array.name));
      index = clamped;
    }
    offset = offset * size + static_cast<std::size_t>(index);
  }
  return array.first_slot + offset;
}

void Machine::print(const Instruction& instruction, const double* values) {
  const std::string& format = grammar_.strings[instruction.operand / 256];
  notify(listener_, format_printf(format, std::vector<double>(values, values + instruction.operand % 256)));
}

void Machine::refuse_iteration(const Instruction& instruction) const {
  throw LimitError(grammar_.source.place(instruction.place),
                   fmt::format("the loops of these statements ran {} times; this one may never end", kMaxIterations));
}

double Machine::run_instructions(const Program& program) {
  double stack[kMaxStack];
  double* top = stack;  // one past the topmost number
  const auto binary = [&top](auto&& result) {
    --top;
    top[-1] = result(top[-1], top[0]);
  };
  const auto unary = [&top](auto&& result) { top[-1] = result(top[-1]); };
  RandomStreams& random = state.random;
  std::uint64_t iterations = 0;

  for (std::size_t next = 0; next < program.size();) {
    const Instruction& instruction = program[next++];
    switch (instruction.op) {
      case Op::kConstant:
        *top++ = instruction.constant;
        break;
      case Op::kLoad:
        *top++ = state.slots[instruction.operand];
        break;
      case Op::kStore:
        state.slots[instruction.operand] = *--top;
        break;
      case Op::kLoadElement:
        top -= grammar_.arrays[instruction.operand].sizes.size();
        *top = state.slots[element_slot(instruction, top)];
        ++top;
        break;
      case Op::kStoreElement:
        top -= grammar_.arrays[instruction.operand].sizes.size() + 1;
        state.slots[element_slot(instruction, top + 1)] = *top;
        break;
      case Op::kPop:
        --top;
        break;
      case Op::kJump:
        next = instruction.operand;
        break;
      case Op::kJumpIfZero:
        if (*--top == 0) next = instruction.operand;
        break;
      case Op::kAndJump:
        if (top[-1] == 0) {
          next = instruction.operand;
        } else {
          --top;
        }
        break;
      case Op::kOrJump:
        if (top[-1] != 0) {
          top[-1] = 1;
          next = instruction.operand;
        } else {
          --top;
        }
        break;
      case Op::kToTruth:
        unary([](double a) { return a != 0; });
        break;
      case Op::kCountIteration:
        if (++iterations > kMaxIterations) refuse_iteration(instruction);
        break;
      case Op::kNegate:
        unary([](double a) { return -a; });
        break;
      case Op::kNot:
        unary([](double a) { return a == 0; });
        break;
      case Op::kAdd:
        binary([](double a, double b) { return a + b; });
        break;
      case Op::kSubtract:
        binary([](double a, double b) { return a - b; });
        break;
      case Op::kMultiply:
        binary([](double a, double b) { return a * b; });
        break;
      case Op::kDivide:
        if (top[-1] == 0) {
          warn(instruction.place, "division by 0; the dividend is used as the quotient");
          top[-1] = 1;
        }
        binary([](double a, double b) { return a / b; });
        break;
      case Op::kRemainder:
        binary([&](double a, double b) { return remainder(a, b, instruction.place); });
        break;
      case Op::kPower:
        binary([](double a, double b) { return std::pow(a, b); });
        break;
      case Op::kEqual:
        binary([](double a, double b) { return a == b; });
        break;
      case Op::kNotEqual:
        binary([](double a, double b) { return a != b; });
        break;
      case Op::kLess:
        binary([](double a, double b) { return a < b; });
        break;
      case Op::kLessEqual:
        binary([](double a, double b) { return a <= b; });
        break;
      case Op::kGreater:
        binary([](double a, double b) { return a > b; });
        break;
      case Op::kGreaterEqual:
        binary([](double a, double b) { return a >= b; });
        break;
      case Op::kSin:
        unary([](double a) { return std::sin(radians(a)); });
        break;
      case Op::kCos:
        unary([](double a) { return std::cos(radians(a)); });
        break;
      case Op::kTan:
        unary([](double a) { return std::tan(radians(a)); });
        break;
      case Op::kAsin:
        unary([](double a) { return degrees(std::asin(a)); });
        break;
      case Op::kAcos:
        unary([](double a) { return degrees(std::acos(a)); });
        break;
      case Op::kAtan:
        unary([](double a) { return degrees(std::atan(a)); });
        break;
      case Op::kExp:
        unary([](double a) { return std::exp(a); });
        break;
      case Op::kLog:
        unary([](double a) { return std::log(a); });
        break;
      case Op::kFloor:
        unary([](double a) { return std::floor(a); });
        break;
      case Op::kCeil:
        unary([](double a) { return std::ceil(a); });
        break;
      case Op::kSqrt:
        unary([](double a) { return std::sqrt(a); });
        break;
      case Op::kFabs:
        unary([](double a) { return std::fabs(a); });
        break;
      case Op::kSign:
        unary([](double a) { return a == 0 ? 0.0 : a > 0 ? 1.0 : -1.0; });
        break;
      case Op::kRound:
        unary([](double a) { return std::floor(a + 0.5); });
        break;
      case Op::kRan:
        unary([&](double a) { return random.uniform.next() * a; });
        break;
      case Op::kNran:
        binary([&](double a, double b) { return random.normal(a, b); });
        break;
      case Op::kBran:
        binary([&](double a, double b) { return random.beta(a, b); });
        break;
      case Op::kBiran:
        binary([&](double a, double b) { return random.binomial(to_integer<std::int32_t>(a), b); });
        break;
      case Op::kSrand:
        random.seed_uniform(to_integer<std::int64_t>(top[-1]));
        top[-1] = 0;
        break;
      case Op::kPrintf:
        top -= instruction.operand % 256;
        print(instruction, top);
        *top++ = 0;
        break;
      case Op::kStop:
        state.stopped = state.stopped || top[-1] != 1;
        break;
      case Op::kGetDerivationLength:
        top[-1] = state.derivation_length;
        break;
      case Op::kSetDerivationLength:
        state.derivation_length = to_integer<std::int32_t>(top[-1]);
        top[-1] = 0;
        break;
      case Op::kGetTime:
        top[-1] = state.time;
        break;
    }
  }
  return top == stack ? 0.0 : top[-1];
}

std::string format_printf(const std::string& format, const std::vector<double>& values) {
  std::string result;
  std::size_t used = 0;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') {
      result += format[i];
      continue;
    }
    const std::size_t end = format.find_first_not_of("+- #0123456789.", i + 1);
    const char conversion = end == std::string::npos ? '\0' : format[end];
    const std::string options = format.substr(i + 1, (end == std::string::npos ? format.size() : end) - i - 1);
    if (conversion == '%') {
      result += '%';
    } else if (std::string_view("gGeEfFdiu").find(conversion) != std::string_view::npos && options.size() < 6) {
      const double value = used < values.size() ? values[used++] : 0;
      const bool whole = std::string_view("diu").find(conversion) != std::string_view::npos;
      result += whole ? fmt::sprintf('%' + options + "d", to_integer<std::int64_t>(value))
                      : fmt::sprintf('%' + options + conversion, value);
    } else {
      result += format.substr(i, options.size() + 2);
    }
    i = end == std::string::npos ? format.size() : end;
  }
  return result;
}

}  // namespace barkridge
