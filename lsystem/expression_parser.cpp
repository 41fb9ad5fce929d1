#include "lsystem/expression_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "lsystem/characters.h"
#include "lsystem/machine.h"

namespace barkridge {

namespace {

// Parentheses, signs and statements within each other; each level is some levels of recursion.
constexpr int kMaxNesting = 200;
constexpr double kMaxArrayElements = 1 << 20;

struct BinaryOperator {
  std::string_view spelling;
  int precedence;
  Op op;
};
// cpfg's precedences. Longer spellings come before their beginnings.
constexpr std::array<BinaryOperator, 15> kOperators{{{"||", 1, Op::kOrJump},
                                                     {"&&", 2, Op::kAndJump},
                                                     {"==", 3, Op::kEqual},
                                                     {"!=", 3, Op::kNotEqual},
                                                     {"<>", 3, Op::kNotEqual},
                                                     {"<=", 4, Op::kLessEqual},
                                                     {">=", 4, Op::kGreaterEqual},
                                                     {"<", 4, Op::kLess},
                                                     {">", 4, Op::kGreater},
                                                     {"+", 5, Op::kAdd},
                                                     {"-", 5, Op::kSubtract},
                                                     {"*", 6, Op::kMultiply},
                                                     {"/", 6, Op::kDivide},
                                                     {"%", 6, Op::kRemainder},
                                                     {"^", 7, Op::kPower}}};

constexpr std::array<std::string_view, 20> kUnsupportedFunctions{
    "inblob", "fprintf",  "fopen",  "fclose", "fflush", "fscanf", "func",   "play",   "curveX",  "curveY",
    "curveZ", "curveGAL", "vvXmin", "vvXmax", "vvYmin", "vvYmax", "vvZmin", "vvZmax", "vvScale", "Display"};

constexpr std::array<std::string_view, 6> kKeywords{"if", "else", "while", "do", "array", "external"};

template <typename List>
bool contains(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

const BinaryOperator* operator_at(std::string_view text) {
  if (text.starts_with("-->") || text.starts_with("-o>")) return nullptr;
  for (const BinaryOperator& candidate : kOperators) {
    if (text.starts_with(candidate.spelling)) return &candidate;
  }
  return nullptr;
}

}  // namespace

const Scope::Symbol* Scope::find(std::string_view name) const {
  for (const Scope* scope = this; scope != nullptr; scope = scope->parent) {
    if (const auto found = scope->symbols.find(name); found != scope->symbols.end()) return &found->second;
  }
  return nullptr;
}

std::uint32_t ExpressionParser::declare(const std::string& name, Scope& scope, std::uint32_t place) {
  if (!scope.symbols.emplace(name, Scope::Symbol{false, grammar_.slot_count}).second) {
    scanner_.fail_at(place, fmt::format("`{}` is already defined here", name));
  }
  return grammar_.slot_count++;
}

// Emission.

void ExpressionParser::change_height(int change, std::uint32_t place) {
  height_ += change;
  if (height_ > kMaxStack) scanner_.fail_at(place, "this expression is too large");
}

void ExpressionParser::emit(Op op, std::uint32_t place, std::uint32_t operand) {
  Instruction instruction{op, place, {}};
  instruction.operand = operand;
  code_.push_back(instruction);
  change_height(stack_effect(op), place);
}

void ExpressionParser::emit_constant(double value, std::uint32_t place) {
  emit(Op::kConstant, place);
  code_.back().constant = value;
}

std::size_t ExpressionParser::emit_jump(Op op, std::uint32_t place) {
  emit(op, place);
  return code_.size() - 1;
}

void ExpressionParser::land(std::size_t jump) { code_[jump].operand = static_cast<std::uint32_t>(code_.size()); }

template <typename Parse>
Program ExpressionParser::compile(Parse&& parse) {
  Program enclosing;
  std::swap(code_, enclosing);
  const int enclosing_height = height_;
  height_ = 0;
  parse();
  std::swap(code_, enclosing);
  height_ = enclosing_height;
  return enclosing;
}

// Expressions.

Program ExpressionParser::expression(Scope& scope) {
  return compile([&] { conditional(scope, 0); });
}

double ExpressionParser::evaluate(Scope& scope) {
  const Program program = expression(scope);
  return Machine(grammar_, listener_).run(program);
}

void ExpressionParser::conditional(Scope& scope, int nesting) {
  binary(scope, 1, nesting);
  if (scanner_.peek() != '?') return;
  const std::uint32_t place = scanner_.place();
  scanner_.accept("?");
  const std::size_t to_no = emit_jump(Op::kJumpIfZero, place);
  conditional(scope, nesting + 1);
  scanner_.expect(":", "in a choice `a ? b : c`");
  const std::size_t to_end = emit_jump(Op::kJump, place);
  land(to_no);
  change_height(-1, place);  // only one of the two values is there
  conditional(scope, nesting + 1);
  land(to_end);
}

void ExpressionParser::binary(Scope& scope, int least_precedence, int nesting) {
  unary(scope, nesting);
  for (;;) {
    const std::uint32_t place = scanner_.place();
    const BinaryOperator* const found = operator_at(scanner_.text().substr(place));
    if (found == nullptr || found->precedence < least_precedence) return;
    scanner_.accept(found->spelling);
    const bool lazy = found->op == Op::kAndJump || found->op == Op::kOrJump;
    const std::size_t jump = lazy ? emit_jump(found->op, place) : 0;
    binary(scope, found->precedence + 1, nesting + 1);
    if (lazy) {
      emit(Op::kToTruth, place);
      land(jump);
    } else {
      emit(found->op, place);
    }
  }
}

void ExpressionParser::unary(Scope& scope, int nesting) {
  if (nesting > kMaxNesting) scanner_.fail(fmt::format("expressions are nested more than {} deep", kMaxNesting));
  const std::uint32_t place = scanner_.place();
  const bool negate = !scanner_.at_arrow() && scanner_.accept("-");
  if (negate || scanner_.accept("!")) {
    unary(scope, nesting + 1);
    emit(negate ? Op::kNegate : Op::kNot, place);
  } else {
    primary(scope, nesting);
  }
}

void ExpressionParser::primary(Scope& scope, int nesting) {
  const char next = scanner_.peek();
  if (scanner_.accept("(")) {
    conditional(scope, nesting + 1);
    if (scanner_.peek() == '=') scanner_.fail("`=` assigns and stands in statements only; `==` compares");
    scanner_.expect(")", "to close a parenthesis");
  } else if (is_digit(next) || (next == '.' && is_digit(scanner_.peek_second()))) {
    number();
  } else if (next == '"') {
    const std::uint32_t place = scanner_.place();
    emit_constant(string_index(), place);
  } else if (is_letter(next)) {
    name(scope, nesting);
  } else if (next == '&') {
    scanner_.fail("`&`, the address for fscanf, is not supported yet");
  } else {
    scanner_.fail("expected a number, a name or `(`, not " + scanner_.describe_next());
  }
}

void ExpressionParser::number() {
  const std::uint32_t place = scanner_.place();
  const std::string_view text = scanner_.text().substr(place);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) scanner_.fail_at(place, "this number is out of range");
  scanner_.set_position(place + static_cast<std::size_t>(end - text.data()));
  emit_constant(value, place);
}

std::uint32_t ExpressionParser::string_index() {
  const std::uint32_t place = scanner_.place();
  const std::string_view text = scanner_.text();
  std::string value;
  std::size_t at = place + 1;
  for (; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\n') break;
    if (text[at] == '\\' && at + 1 < text.size()) {
      const char escaped = text[++at];
      value += escaped == 'n' ? '\n' : escaped == 't' ? '\t' : escaped == 'r' ? '\r' : escaped;
    } else {
      value += text[at];
    }
  }
  if (at >= text.size() || text[at] != '"') scanner_.fail_at(place, "this string lacks its closing quote");
  scanner_.set_position(at + 1);
  grammar_.strings.push_back(std::move(value));
  return static_cast<std::uint32_t>(grammar_.strings.size() - 1);
}

void ExpressionParser::name(Scope& scope, int nesting) {
  const std::uint32_t place = scanner_.place();
  const std::string word = scanner_.accept_name();
  if (contains(kKeywords, word)) scanner_.fail_at(place, fmt::format("`{}` cannot stand in an expression", word));
  const bool is_function =
      word == "printf" || word == "atan2" || find_function(word) != nullptr || contains(kUnsupportedFunctions, word);
  if (is_function || scanner_.peek() == '(') return call(word, place, scope, nesting);
  if (scanner_.peek() == '[') return element(Op::kLoadElement, word, place, scope, nesting);
  emit(Op::kLoad, place, variable(word, place, scope, false));
}

std::uint32_t ExpressionParser::variable(const std::string& name, std::uint32_t place, Scope& scope, bool assigned) {
  const Scope::Symbol* const symbol = scope.find(name);
  if (symbol == nullptr) {
    if (!assigned) {
      notify(listener_,
             message_at(grammar_.source.place(place), fmt::format("`{}` is not defined; it starts as 0", name)));
    }
    return declare(name, scope, place);
  }
  if (symbol->is_array) scanner_.fail_at(place, fmt::format("`{}` is an array and needs an index", name));
  return symbol->index;
}

void ExpressionParser::call(const std::string& function, std::uint32_t place, Scope& scope, int nesting) {
  if (function == "printf") return print(place, scope, nesting);
  if (contains(kUnsupportedFunctions, function)) {
    scanner_.fail_at(place, fmt::format("the function `{}` is not supported yet", function));
  }
  if (function == "atan2") scanner_.fail_at(place, "`atan2` is no function of cpfg's grammar; use `atan`");
  const FunctionInfo* const info = find_function(function);
  if (info == nullptr) scanner_.fail_at(place, fmt::format("`{}` is not a function", function));
  scanner_.expect("(", "after a function's name");
  int count = 0;
  do {
    conditional(scope, nesting + 1);
    ++count;
  } while (scanner_.accept(","));
  scanner_.expect(")", fmt::format("to end the arguments of `{}`", function));
  if (count != info->argument_count) {
    scanner_.fail_at(place, fmt::format("`{}` takes {} argument{}, but {} are given", function, info->argument_count,
                                        info->argument_count == 1 ? "" : "s", count));
  }
  emit(info->op, place);
}

void ExpressionParser::print(std::uint32_t place, Scope& scope, int nesting) {
  scanner_.expect("(", "after a function's name");
  if (scanner_.peek() != '"') scanner_.fail("`printf` needs a format in double quotes first");
  const std::uint32_t format = string_index();
  std::uint32_t count = 0;
  while (scanner_.accept(",")) {
    conditional(scope, nesting + 1);
    if (++count > 255) scanner_.fail_at(place, "`printf` takes at most 255 values");
  }
  scanner_.expect(")", "to end the arguments of `printf`");
  emit(Op::kPrintf, place, format * 256 + count);
  change_height(-static_cast<int>(count), place);
}

void ExpressionParser::element(Op op, const std::string& array, std::uint32_t place, Scope& scope, int nesting) {
  const Scope::Symbol* const symbol = scope.find(array);
  if (symbol == nullptr || !symbol->is_array) scanner_.fail_at(place, fmt::format("`{}` is not an array", array));
  const std::uint32_t index = symbol->index;
  const std::size_t dimensions = grammar_.arrays[index].sizes.size();
  std::size_t count = 0;
  while (scanner_.accept("[")) {
    conditional(scope, nesting + 1);
    scanner_.expect("]", "after an index");
    ++count;
  }
  if (count != dimensions) {
    scanner_.fail_at(place, fmt::format("array `{}` has {} indices, but {} are given", array, dimensions, count));
  }
  emit(op, place, index);
  change_height(-static_cast<int>(dimensions), place);
}

// Statements.

Program ExpressionParser::block(Scope& scope) {
  return compile([&] { statements(scope, 0); });
}

void ExpressionParser::statements(Scope& scope, int nesting) {
  if (nesting > kMaxNesting) scanner_.fail(fmt::format("statements are nested more than {} deep", kMaxNesting));
  const std::uint32_t start = scanner_.place();
  scanner_.expect("{", "to begin statements");
  scanner_.open_brace();
  while (scanner_.peek() != '}') {
    if (scanner_.at_end()) scanner_.fail_at(start, "these statements lack their `}`");
    statement(scope, nesting + 1);
  }
  scanner_.accept("}");
  scanner_.close_brace();
}

void ExpressionParser::statement(Scope& scope, int nesting) {
  const std::size_t start = scanner_.place();
  const std::string word = scanner_.accept_name();
  if (word == "if") return if_statement(scope, nesting);
  if (word == "while") return while_statement(scope, nesting);
  if (word == "do") return do_statement(scope, nesting);
  scanner_.set_position(start);
  if (at_assignment()) {
    assignment(scope, nesting);
  } else {
    conditional(scope, nesting);
    emit(Op::kPop, static_cast<std::uint32_t>(start));
  }
  scanner_.expect(";", "after a statement");
}

/// Whether a name, perhaps with indices, and `=` come next.
bool ExpressionParser::at_assignment() {
  const std::size_t start = scanner_.position();
  bool found = !scanner_.accept_name().empty();
  while (found && scanner_.accept("[")) {
    for (int depth = 1; depth > 0 && !scanner_.at_end();) {
      depth += (scanner_.peek() == '[') - (scanner_.peek() == ']');
      scanner_.set_position(scanner_.position() + 1);
    }
  }
  found = found && scanner_.peek() == '=' && scanner_.text().substr(scanner_.position(), 2) != "==";
  scanner_.set_position(start);
  return found;
}

void ExpressionParser::assignment(Scope& scope, int nesting) {
  const std::uint32_t place = scanner_.place();
  const std::string name = scanner_.accept_name();
  if (scanner_.peek() != '[') {
    scanner_.expect("=", "in an assignment");
    conditional(scope, nesting);
    emit(Op::kStore, place, variable(name, place, scope, true));
    return;
  }
  // cpfg evaluates the indices after the value, which matters to random numbers.
  const Program store = compile([&] {
    ++height_;  // the value below the indices
    element(Op::kStoreElement, name, place, scope, nesting);
  });
  scanner_.expect("=", "in an assignment");
  conditional(scope, nesting);
  append_program(code_, store);
  change_height(-1, place);
}

void ExpressionParser::if_statement(Scope& scope, int nesting) {
  const std::uint32_t place = scanner_.place();
  scanner_.expect("(", "after `if`");
  conditional(scope, nesting);
  scanner_.expect(")", "after the condition");
  const std::size_t to_else = emit_jump(Op::kJumpIfZero, place);
  statements(scope, nesting);
  const std::size_t before_else = scanner_.position();
  if (scanner_.accept_name() == "else") {
    const std::size_t to_end = emit_jump(Op::kJump, place);
    land(to_else);
    statements(scope, nesting);
    land(to_end);
  } else {
    scanner_.set_position(before_else);
    land(to_else);
  }
}

void ExpressionParser::while_statement(Scope& scope, int nesting) {
  const std::uint32_t place = scanner_.place();
  const auto start = static_cast<std::uint32_t>(code_.size());
  emit(Op::kCountIteration, place);
  scanner_.expect("(", "after `while`");
  conditional(scope, nesting);
  scanner_.expect(")", "after the condition");
  const std::size_t to_end = emit_jump(Op::kJumpIfZero, place);
  statements(scope, nesting);
  emit(Op::kJump, place, start);
  land(to_end);
}

void ExpressionParser::do_statement(Scope& scope, int nesting) {
  const std::uint32_t place = scanner_.place();
  const auto start = static_cast<std::uint32_t>(code_.size());
  emit(Op::kCountIteration, place);
  statements(scope, nesting);
  if (scanner_.accept_name() != "while") scanner_.fail_at(place, "this `do` lacks its `while`");
  scanner_.expect("(", "after `while`");
  conditional(scope, nesting);
  scanner_.expect(")", "after the condition");
  scanner_.expect(";", "after a statement");
  emit(Op::kNot, place);
  emit(Op::kJumpIfZero, place, start);
}

// Arrays.

Program ExpressionParser::array_definitions(Scope& scope) {
  return compile([&] {
    const std::uint32_t start = scanner_.place();
    scanner_.expect("{", "after `define:`");
    scanner_.open_brace();
    while (!scanner_.accept("}")) {
      if (scanner_.at_end()) scanner_.fail_at(start, "these definitions lack their `}`");
      const std::uint32_t place = scanner_.place();
      const std::string word = scanner_.accept_name();
      if (word == "external") scanner_.fail_at(place, "`external`, of sub-L-systems, is not supported yet");
      if (word != "array") scanner_.fail_at(place, "expected `array` in `define:`");
      do {
        array_definition(scope);
      } while (scanner_.accept(","));
      scanner_.expect(";", "after array definitions");
    }
    scanner_.close_brace();
  });
}

void ExpressionParser::array_definition(Scope& scope) {
  const std::uint32_t place = scanner_.place();
  const std::string name = scanner_.accept_name();
  if (name.empty()) scanner_.fail("expected an array's name, not " + scanner_.describe_next());
  if (scanner_.peek() != '[') scanner_.fail("expected the array's size in brackets");
  ArrayVariable array{name, {}, 0};
  double elements = 1;
  while (scanner_.accept("[")) {
    const std::uint32_t size_place = scanner_.place();
    const double size = std::trunc(evaluate(scope));
    scanner_.expect("]", "after an array's size; each index has brackets of its own");
    if (!(size >= 1)) scanner_.fail_at(size_place, "an array's size must be at least 1");
    elements *= size;
    if (elements > kMaxArrayElements) {
      throw LimitError(grammar_.source.place(size_place),
                       fmt::format("an array may have at most {} elements", kMaxArrayElements));
    }
    array.sizes.push_back(static_cast<std::uint32_t>(size));
  }
  const auto index = static_cast<std::uint32_t>(grammar_.arrays.size());
  if (!scope.symbols.emplace(name, Scope::Symbol{true, index}).second) {
    scanner_.fail_at(place, fmt::format("`{}` is already defined here", name));
  }
  array.first_slot = grammar_.slot_count;
  grammar_.slot_count += static_cast<std::uint32_t>(elements);
  if (grammar_.slot_count > 16 * kMaxArrayElements) {
    throw LimitError(grammar_.source.place(place), "the L-system's arrays are too large");
  }
  grammar_.arrays.push_back(array);
  if (!scanner_.accept("=")) return;
  scanner_.expect("{", "before an array's values");
  double count = 0;
  do {
    const std::uint32_t value_place = scanner_.place();
    if (count == elements) scanner_.fail_at(value_place, fmt::format("`{}` has only {} elements", name, elements));
    conditional(scope, 0);
    emit(Op::kStore, value_place, array.first_slot + static_cast<std::uint32_t>(count++));
  } while (scanner_.accept(","));
  scanner_.expect("}", "after an array's values");
  if (count < elements) {
    notify(listener_,
           message_at(grammar_.source.place(place),
                      fmt::format("`{}` has {} elements, but {} values; the rest are 0", name, elements, count)));
  }
}

}  // namespace barkridge
