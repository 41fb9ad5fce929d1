#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "lsystem/characters.h"
#include "lsystem/expression_parser.h"
#include "lsystem/grammar.h"
#include "lsystem/grammar_definition.h"
#include "lsystem/preprocessor.h"
#include "lsystem/scanner.h"

namespace barkridge {

namespace {

constexpr std::size_t kMaxParameters = 255;  // Word::Module counts them in a byte

constexpr std::array<std::string_view, 11> kHeaderKeywords{
    "lsystem:", "seed:", "derivation~length:", "consider:", "ignore:", "axiom:", "define:",
    "start:",   "end:",  "start~each:",        "end~each:"};

class GrammarParser {
 public:
  GrammarParser(GrammarDefinition& grammar, const Notify& listener)
      : grammar_(grammar), listener_(listener), scanner_(grammar.source), expressions_(scanner_, grammar, listener) {
    globals_.symbols["Q"] = {false, kStepSlot};
    globals_.symbols["Z"] = {false, kLengthSlot};
  }

  void run() {
    parse_label();
    while (!accept_header("axiom:")) parse_item();
    if (scanner_.at_line_end()) scanner_.fail("expected the axiom's modules");
    grammar_.axiom = parse_modules(globals_);
    scanner_.expect_line_end("the axiom");
    const bool empty_line = scanner_.at_line_end();  // in cpfg it stands for a production
    parse_productions(grammar_.productions);
    if (grammar_.productions.empty() && !empty_line) scanner_.fail("expected a production after the axiom");
    if (scanner_.accept_keyword("decomposition")) parse_section(grammar_.decomposition, "decomposition");
    if (scanner_.accept_keyword("homomorphism")) parse_section(grammar_.homomorphism, "homomorphism");
    parse_end();
  }

 private:
  bool accept_header(std::string_view keyword) {
    scanner_.skip_empty_lines();
    return scanner_.accept_keyword(keyword);
  }

  void parse_label() {
    if (!accept_header("lsystem:")) {
      scanner_.fail("expected `Lsystem: label`, not " + scanner_.describe_next() +
                    "; only cpfg's language is supported yet");
    }
    grammar_.label = std::string(trim(scanner_.rest_of_line()));
    if (grammar_.label.empty()) scanner_.fail("expected a label after `Lsystem:`, such as 1");
    scanner_.expect_line_end("the label");
  }

  void parse_item() {
    const std::uint32_t place = scanner_.place();
    if (scanner_.accept_keyword("seed:")) {
      grammar_.seed = static_cast<std::int64_t>(whole_number("the seed"));
    } else if (scanner_.accept_keyword("derivation~length:")) {
      grammar_.derivation_length = static_cast<int>(whole_number("the derivation length"));
    } else if (scanner_.accept_keyword("consider:")) {
      grammar_.ignored.set();
      set_ignored(false);
    } else if (scanner_.accept_keyword("ignore:")) {
      grammar_.ignored.reset();
      set_ignored(true);
    } else if (scanner_.accept_keyword("define:")) {
      append_program(grammar_.define, expressions_.array_definitions(globals_));
    } else if (scanner_.accept_keyword("start:")) {
      grammar_.start = expressions_.block(globals_);
    } else if (scanner_.accept_keyword("end:")) {
      grammar_.end = expressions_.block(globals_);
    } else if (scanner_.accept_keyword("start~each:")) {
      grammar_.start_each = expressions_.block(globals_);
    } else if (scanner_.accept_keyword("end~each:")) {
      grammar_.end_each = expressions_.block(globals_);
    } else if (scanner_.accept_keyword("ring lsystem")) {
      scanner_.fail_at(place, "ring L-systems are not supported yet");
    } else {
      scanner_.fail("expected `axiom:` or an item such as `derivation length:` before it, not " +
                    scanner_.describe_next());
    }
    scanner_.expect_line_end("this item");
  }

  /// An expression that counts something, known before the L-system runs; its fraction is cut off.
  double whole_number(std::string_view what) {
    const std::uint32_t place = scanner_.place();
    const double value = std::trunc(expressions_.evaluate(globals_));
    if (!(std::fabs(value) <= 2147483647)) scanner_.fail_at(place, fmt::format("{} is out of range", what));
    return value;
  }

  void set_ignored(bool ignored) {
    while (!scanner_.at_line_end()) grammar_.ignored.set(static_cast<std::size_t>(parse_symbol()), ignored);
  }

  // Modules.

  char parse_symbol() {
    const char symbol = scanner_.peek();
    if (!is_visible_ascii(symbol)) {
      scanner_.fail(scanner_.at_line_end() ? "expected a module, not " + scanner_.describe_next()
                                           : "modules are single visible ASCII characters");
    }
    if (std::string_view("<>:*()").find(symbol) != std::string_view::npos) {
      scanner_.fail("expected a module, not " + scanner_.describe_next());
    }
    scanner_.set_position(scanner_.position() + 1);
    return symbol;
  }

  bool at_module() {
    return !scanner_.at_line_end() && !scanner_.at_arrow() &&
           std::string_view("<>:*").find(scanner_.peek()) == std::string_view::npos;
  }

  /// Refuses, rather than misreads, what has a meaning of its own that this program does not know yet.
  void check_supported(char symbol, std::uint32_t place) {
    const bool parameters = scanner_.peek() == '(';
    if (symbol == '?' && !parameters) scanner_.fail_at(place, "queries and communication (`?`) are not supported yet");
    if (symbol == '?') scanner_.fail_at(place, "sub-L-systems (`?(...)`) are not supported yet");
    if (symbol == '$') {
      scanner_.fail_at(place, "sub-L-systems (`$`) are not supported yet; to roll to the horizontal write `@v`");
    }
    if (symbol == '%' && parameters) scanner_.fail_at(place, "`%` with parameters is not supported yet");
  }

  std::vector<ModuleTemplate> parse_modules(Scope& scope) {
    std::vector<ModuleTemplate> modules;
    while (at_module()) {
      const std::uint32_t place = scanner_.place();
      ModuleTemplate module{parse_symbol(), {}};
      check_supported(module.symbol, place);
      if (scanner_.accept("(")) {
        do {
          module.parameters.push_back(expressions_.expression(scope));
        } while (scanner_.accept(","));
        scanner_.expect(")", "after a module's parameters");
      }
      if (module.parameters.size() > kMaxParameters) scanner_.fail_at(place, "a module has at most 255 parameters");
      modules.push_back(std::move(module));
    }
    return modules;
  }

  std::vector<ModulePattern> parse_patterns(Scope& scope) {
    std::vector<ModulePattern> patterns;
    while (at_module()) {
      const std::uint32_t place = scanner_.place();
      ModulePattern pattern{parse_symbol(), {}};
      check_supported(pattern.symbol, place);
      if (scanner_.accept("(")) {
        do {
          const std::uint32_t name_place = scanner_.place();
          const std::string name = scanner_.accept_name();
          if (name.empty()) scanner_.fail("expected a parameter's name, not " + scanner_.describe_next());
          pattern.slots.push_back(expressions_.declare(name, scope, name_place));
        } while (scanner_.accept(","));
        scanner_.expect(")", "after a module's parameters");
      }
      if (pattern.slots.size() > kMaxParameters) scanner_.fail_at(place, "a module has at most 255 parameters");
      patterns.push_back(std::move(pattern));
    }
    return patterns;
  }

  // Productions.

  void parse_productions(ProductionSet& set) {
    for (;;) {
      scanner_.skip_empty_lines();
      if (scanner_.at_end() || at_section_end()) return;
      set.productions.push_back(parse_production());
      const Production& production = set.productions.back();
      const auto index = static_cast<std::uint32_t>(set.productions.size() - 1);
      set.by_symbol[static_cast<std::size_t>(production.predecessor[0].symbol)].push_back(index);
      set.has_contexts |= !production.left_context.empty() || !production.right_context.empty();
    }
  }

  bool at_section_end() {
    const std::size_t start = scanner_.position();
    for (const std::string_view keyword : kHeaderKeywords) {
      if (scanner_.accept_keyword(keyword)) scanner_.fail_at(start, "this item must stand before the axiom");
    }
    bool found = false;
    for (const std::string_view keyword : {"decomposition", "homomorphism", "end|lsystem"}) {
      found = found || scanner_.accept_keyword(keyword);
    }
    scanner_.set_position(start);
    return found;
  }

  Production parse_production() {
    Scope scope{{}, &globals_};
    Production production;
    production.place = scanner_.place();
    production.predecessor = parse_context(scope);
    if (scanner_.accept("<")) {
      production.left_context = std::move(production.predecessor);
      production.predecessor = parse_patterns(scope);
    }
    if (production.predecessor.empty()) scanner_.fail("expected a predecessor, not " + scanner_.describe_next());
    if (scanner_.accept(">")) {
      const std::size_t after = scanner_.position();
      production.right_context = parse_context(scope);
      if (!scanner_.at_arrow() && scanner_.peek() != ':' && production.predecessor.back().symbol == '-') {
        scanner_.fail_at(after - 2, "the arrow of a production is `-->`");
      }
    }
    if (scanner_.accept(":")) parse_condition(production, scope);
    if (!scanner_.accept("-->") && !scanner_.accept("-o>")) {
      scanner_.fail("expected `-->`, not " + scanner_.describe_next() +
                    "; a statement goes on in the next line only if that begins with a tab");
    }
    parse_successor(production, scope);
    scanner_.expect_line_end("a production");
    return production;
  }

  std::vector<ModulePattern> parse_context(Scope& scope) {
    if (scanner_.accept("*")) return {};
    return parse_patterns(scope);
  }

  void parse_condition(Production& production, Scope& scope) {
    if (scanner_.peek() == '{') production.before = expressions_.block(scope);
    if (!scanner_.accept("*")) production.condition = expressions_.expression(scope);
    if (scanner_.peek() == '=') scanner_.fail("`=` assigns and stands in statements only; `==` compares");
    if (scanner_.peek() == '{') production.after = expressions_.block(scope);
  }

  void parse_successor(Production& production, Scope& scope) {
    if (!scanner_.accept("*")) {
      if (!at_module()) scanner_.fail("expected a successor, or `*` for none, not " + scanner_.describe_next());
      production.successor = parse_modules(scope);
    }
    const std::uint32_t place = scanner_.place();
    if (!scanner_.accept(":")) return;
    production.weight = expressions_.expression(scope);
    if (!grammar_.seed) {
      notify(listener_, message_at(grammar_.source.place(place),
                                   "this weight has no effect without `seed:`; the first match is taken"));
    }
  }

  void parse_section(ProductionSet& set, std::string_view name) {
    scanner_.accept(":");
    if (scanner_.accept_keyword("no warnings")) {
      set.warnings = false;
    } else {
      scanner_.accept_keyword("warnings");
    }
    scanner_.expect_line_end(name);
    for (;;) {
      scanner_.skip_empty_lines();
      if (scanner_.accept_keyword("maximum depth:")) {
        set.maximum_depth = static_cast<int>(whole_number("the maximum depth"));
      } else if (&set == &grammar_.homomorphism && scanner_.accept_keyword("seed:")) {
        const double seed = whole_number("the seed");
        if (seed >= 0) grammar_.homomorphism_seed = static_cast<std::int64_t>(seed);
      } else {
        break;
      }
      scanner_.expect_line_end("this item");
    }
    parse_productions(set);
  }

  void parse_end() {
    const std::uint32_t place = scanner_.place();
    if (scanner_.accept_keyword("decomposition")) {
      scanner_.fail_at(place, "the decomposition must stand once, before the homomorphism");
    }
    if (!scanner_.accept_keyword("end|lsystem")) {
      scanner_.fail("expected `endlsystem`, not " + scanner_.describe_next());
    }
    scanner_.expect_line_end("`endlsystem`");
    scanner_.skip_empty_lines();
    const std::uint32_t rest = scanner_.place();
    if (scanner_.accept_keyword("lsystem:")) scanner_.fail_at(rest, "sub-L-systems are not supported yet");
    if (!scanner_.at_end()) scanner_.fail("unexpected " + scanner_.describe_next() + " after `endlsystem`");
  }

  GrammarDefinition& grammar_;
  const Notify& listener_;
  Scanner scanner_;
  ExpressionParser expressions_;
  Scope globals_;
};

}  // namespace

Grammar parse_grammar(std::string_view text, const std::string& file, const std::map<std::string, std::string>& defines,
                      const Notify& listener) {
  auto grammar = std::make_shared<GrammarDefinition>();
  grammar->source = preprocess(text, file, defines, listener);
  GrammarParser(*grammar, listener).run();
  return Grammar(std::move(grammar));
}

}  // namespace barkridge
