#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "lsystem/grammar_definition.h"
#include "lsystem/notify.h"
#include "lsystem/program.h"
#include "lsystem/scanner.h"

namespace barkridge {

/// The names that are known at a place: of the L-system, and inside a production its own before those.
struct Scope {
  struct Symbol {
    bool is_array = false;
    std::uint32_t index = 0;  ///< the slot, or the index among the arrays
  };
  std::map<std::string, Symbol, std::less<>> symbols;
  const Scope* parent = nullptr;

  const Symbol* find(std::string_view name) const;
};

/// Parses expressions and statements and compiles them. Tells the listener of names that nobody defined; they are 0.
class ExpressionParser {
 public:
  ExpressionParser(Scanner& scanner, GrammarDefinition& grammar, const Notify& listener)
      : scanner_(scanner), grammar_(grammar), listener_(listener) {}

  Program expression(Scope& scope);
  /// Statements in braces.
  Program block(Scope& scope);
  /// What stands between the braces of `define:`, one `array` statement after another; the program initialises them.
  Program array_definitions(Scope& scope);
  /// The value that an expression has before the L-system runs.
  double evaluate(Scope& scope);

  /// A new variable; an error if the scope itself has the name already.
  std::uint32_t declare(const std::string& name, Scope& scope, std::uint32_t place);

 private:
  void emit(Op op, std::uint32_t place, std::uint32_t operand = 0);
  void emit_constant(double value, std::uint32_t place);
  std::size_t emit_jump(Op op, std::uint32_t place);
  void land(std::size_t jump);
  void change_height(int change, std::uint32_t place);
  template <typename Parse>
  Program compile(Parse&& parse);

  void conditional(Scope& scope, int nesting);
  void binary(Scope& scope, int least_precedence, int nesting);
  void unary(Scope& scope, int nesting);
  void primary(Scope& scope, int nesting);
  void number();
  std::uint32_t string_index();
  void name(Scope& scope, int nesting);
  void call(const std::string& function, std::uint32_t place, Scope& scope, int nesting);
  void print(std::uint32_t place, Scope& scope, int nesting);
  void element(Op op, const std::string& array, std::uint32_t place, Scope& scope, int nesting);
  std::uint32_t variable(const std::string& name, std::uint32_t place, Scope& scope, bool assigned);

  void statements(Scope& scope, int nesting);
  void statement(Scope& scope, int nesting);
  bool at_assignment();
  void assignment(Scope& scope, int nesting);
  void if_statement(Scope& scope, int nesting);
  void while_statement(Scope& scope, int nesting);
  void do_statement(Scope& scope, int nesting);
  void array_definition(Scope& scope);

  Scanner& scanner_;
  GrammarDefinition& grammar_;
  const Notify& listener_;
  Program code_;
  int height_ = 0;
};

}  // namespace barkridge
