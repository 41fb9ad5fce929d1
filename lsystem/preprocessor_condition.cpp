#include "lsystem/preprocessor_condition.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

#include "lsystem/characters.h"

namespace barkridge {

namespace {

// Arithmetic wraps, as in a C preprocessor whose integers have 64 bits.
using Integer = std::int64_t;
using Bits = std::uint64_t;

constexpr int kMaxNesting = 200;

struct BinaryOperator {
  std::string_view spelling;
  int precedence;
};
// Longer spellings come before their beginnings.
constexpr std::array<BinaryOperator, 13> kOperators{{{"||", 1},
                                                     {"&&", 2},
                                                     {"==", 3},
                                                     {"!=", 3},
                                                     {"<=", 4},
                                                     {">=", 4},
                                                     {"<", 4},
                                                     {">", 4},
                                                     {"+", 5},
                                                     {"-", 5},
                                                     {"*", 6},
                                                     {"/", 6},
                                                     {"%", 6}}};

class Condition {
 public:
  Condition(std::string_view text, const SourceLocation& place) : text_(text), place_(place) {}

  bool holds() {
    const Integer value = conditional(0);
    skip_blanks();
    if (position_ != text_.size()) fail("unexpected `" + std::string(text_.substr(position_)) + "`");
    return value != 0;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(place_, what + " in the condition of a conditional; it knows integers and C's operators");
  }

  void skip_blanks() {
    while (position_ < text_.size() && is_space(text_[position_])) ++position_;
  }

  bool accept(std::string_view token) {
    skip_blanks();
    if (!text_.substr(position_).starts_with(token)) return false;
    position_ += token.size();
    return true;
  }

  Integer conditional(int nesting) {
    const Integer condition = binary(1, nesting);
    if (!accept("?")) return condition;
    const Integer yes = conditional(nesting + 1);
    if (!accept(":")) fail("missing `:`");
    const Integer no = conditional(nesting + 1);
    return condition != 0 ? yes : no;
  }

  Integer binary(int least_precedence, int nesting) {
    Integer left = unary(nesting);
    for (;;) {
      skip_blanks();
      const BinaryOperator* found = nullptr;
      for (const BinaryOperator& candidate : kOperators) {
        if (text_.substr(position_).starts_with(candidate.spelling)) {
          found = &candidate;
          break;
        }
      }
      if (found == nullptr || found->precedence < least_precedence) return left;
      position_ += found->spelling.size();
      left = apply(found->spelling, left, binary(found->precedence + 1, nesting + 1));
    }
  }

  Integer unary(int nesting) {
    if (nesting > kMaxNesting) fail("too deep nesting");
    if (accept("!")) return unary(nesting + 1) == 0;
    if (accept("-")) return static_cast<Integer>(0 - static_cast<Bits>(unary(nesting + 1)));
    if (accept("+")) return unary(nesting + 1);
    if (accept("(")) {
      const Integer value = conditional(nesting + 1);
      if (!accept(")")) fail("missing `)`");
      return value;
    }
    return primary();
  }

  Integer primary() {
    skip_blanks();
    const std::size_t start = position_;
    while (position_ < text_.size() && (is_name_character(text_[position_]) || text_[position_] == '.')) ++position_;
    const std::string_view word = text_.substr(start, position_ - start);
    if (word.empty()) fail("missing value");
    if (!is_digit(word[0]) && word[0] != '.') return 0;
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      fail("`" + std::string(word) + "` is not an integer");
    }
    return value;
  }

  Integer apply(std::string_view op, Integer left, Integer right) const {
    if (op == "||") return left != 0 || right != 0;
    if (op == "&&") return left != 0 && right != 0;
    if (op == "==") return left == right;
    if (op == "!=") return left != right;
    if (op == "<=") return left <= right;
    if (op == ">=") return left >= right;
    if (op == "<") return left < right;
    if (op == ">") return left > right;
    const Bits a = static_cast<Bits>(left);
    const Bits b = static_cast<Bits>(right);
    if (op == "+") return static_cast<Integer>(a + b);
    if (op == "-") return static_cast<Integer>(a - b);
    if (op == "*") return static_cast<Integer>(a * b);
    if (right == 0) fail("division by zero");
    if (right == -1) return op == "/" ? static_cast<Integer>(0 - a) : 0;  // the only quotient that can overflow
    return op == "/" ? left / right : left % right;
  }

  std::string_view text_;
  const SourceLocation& place_;
  std::size_t position_ = 0;
};

}  // namespace

bool condition_holds(std::string_view expression, const SourceLocation& place) {
  return Condition(expression, place).holds();
}

}  // namespace barkridge
