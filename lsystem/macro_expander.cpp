#include "lsystem/macro_expander.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "lsystem/characters.h"

namespace barkridge {

namespace {

// Arguments within arguments; each level is a level of recursion.
constexpr int kMaxNesting = 200;

std::size_t end_of_name(std::string_view text, std::size_t start) {
  while (start < text.size() && is_name_character(text[start])) ++start;
  return start;
}

// A number as C's preprocessor sees it: letters belong to it, so that `2x` is not the macro `x`.
std::size_t end_of_number(std::string_view text, std::size_t start) {
  while (start < text.size()) {
    const char c = text[start];
    const bool exponent_sign = (c == '+' || c == '-') && (text[start - 1] == 'e' || text[start - 1] == 'E');
    if (!is_name_character(c) && c != '.' && !exponent_sign) break;
    ++start;
  }
  return start;
}

std::size_t end_of_token(std::string_view text, std::size_t start) {
  const char c = text[start];
  if (is_name_start(c)) return end_of_name(text, start);
  if (is_digit(c) || (c == '.' && start + 1 < text.size() && is_digit(text[start + 1]))) {
    return end_of_number(text, start + 1);
  }
  return c == '"' ? end_of_quotes(text, start) : start + 1;
}

class Expander {
 public:
  Expander(std::string_view text, MacroTable& macros, const ExpansionSink& sink, int nesting)
      : macros_(macros), sink_(sink), nesting_(nesting) {
    frames_.push_back({std::string(text), 0, nullptr});
  }

  void run() {
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      if (frame.position == frame.text.size()) {
        pop();
        continue;
      }
      if (frames_.size() == 1) use_ = frame.position;
      const std::size_t start = frame.position;
      frame.position = end_of_token(frame.text, start);
      const std::string token = frame.text.substr(start, frame.position - start);
      if (!is_name_start(token[0]) || !expand(token)) copy(token);
    }
  }

 private:
  /// The text itself at the bottom; above it the expansions that are being read, each inside the one below.
  struct Frame {
    std::string text;
    std::size_t position;
    Macro* macro;
  };

  void pop() {
    if (frames_.back().macro != nullptr) frames_.back().macro->active = false;
    frames_.pop_back();
  }

  void copy(std::string_view token) {
    sink_.spend(token.size());
    if (frames_.size() > 1) {
      sink_.expanded(token, use_);
    } else {
      for (std::size_t i = 0; i < token.size(); ++i) sink_.copied(token[i], use_ + i);
    }
  }

  bool expand(const std::string& name) {
    const auto found = macros_.find(name);
    if (found == macros_.end() || found->second.active) return false;
    Macro& macro = found->second;
    std::string body = macro.body;
    if (macro.takes_arguments) {
      if (!enter_parenthesis()) return false;
      body = substitute(macro, arguments_of(name, macro));
    }
    body = ' ' + body + ' ';
    sink_.spend(body.size());
    macro.active = true;
    frames_.push_back({std::move(body), 0, &macro});
    return true;
  }

  /// Moves behind the `(` that comes next, if it does; leaves the expansions that end before it.
  bool enter_parenthesis() {
    for (std::size_t level = frames_.size(); level-- > 0;) {
      const Frame& frame = frames_[level];
      std::size_t next = frame.position;
      while (next < frame.text.size() && is_space(frame.text[next])) ++next;
      if (next == frame.text.size()) continue;
      if (frame.text[next] != '(') return false;
      while (frames_.size() > level + 1) pop();
      frames_.back().position = next + 1;
      return true;
    }
    return false;
  }

  /// The arguments as written, up to the `)`, which is passed.
  std::vector<std::string> arguments_of(const std::string& name, const Macro& macro) {
    const std::size_t use = use_;
    std::vector<std::string> arguments(1);
    for (int depth = 1; depth > 0;) {
      while (!frames_.empty() && frames_.back().position == frames_.back().text.size()) pop();
      if (frames_.empty()) sink_.fail(use, fmt::format("the arguments of macro `{}` lack their `)`", name));
      Frame& frame = frames_.back();
      const std::size_t start = frame.position;
      frame.position = end_of_token(frame.text, start);
      const std::string_view token = std::string_view(frame.text).substr(start, frame.position - start);
      if (token == "(") ++depth;
      if (token == ")" && --depth == 0) break;
      sink_.spend(token.size());
      if (token == "," && depth == 1) {
        arguments.emplace_back();
      } else {
        arguments.back() += token == "\n" ? " " : token;
      }
    }
    for (std::string& argument : arguments) argument = std::string(trim(argument));
    const bool none = arguments.size() == 1 && arguments[0].empty() && macro.parameters.empty();
    if (none) arguments.clear();
    if (arguments.size() != macro.parameters.size()) {
      sink_.fail(use, fmt::format("macro `{}` takes {} arguments, but {} are given", name, macro.parameters.size(),
                                  arguments.size()));
    }
    return arguments;
  }

  std::string expanded(const std::string& argument) {
    if (nesting_ >= kMaxNesting) {
      sink_.fail(use_, fmt::format("macro arguments are nested more than {} deep", kMaxNesting));
    }
    std::string result;
    const std::size_t use = use_;
    ExpansionSink sink;
    sink.copied = [&](char byte, std::size_t) { result += byte; };
    sink.expanded = [&](std::string_view text, std::size_t) { result += text; };
    sink.fail = [&](std::size_t, const std::string& message) { sink_.fail(use, message); };
    sink.spend = sink_.spend;
    expand_macros(argument, macros_, sink, nesting_ + 1);
    return result;
  }

  std::string substitute(const Macro& macro, const std::vector<std::string>& arguments) {
    std::vector<std::string> values;
    for (const std::string& argument : arguments) values.push_back(expanded(argument));
    std::string result;
    for (std::size_t start = 0; start < macro.body.size();) {
      const std::size_t end = end_of_token(macro.body, start);
      const std::string_view token = std::string_view(macro.body).substr(start, end - start);
      const auto parameter = std::find(macro.parameters.begin(), macro.parameters.end(), token);
      const std::string_view piece =
          parameter == macro.parameters.end()
              ? token
              : std::string_view(values[static_cast<std::size_t>(parameter - macro.parameters.begin())]);
      sink_.spend(piece.size());
      result += piece;
      start = end;
    }
    return result;
  }

  MacroTable& macros_;
  const ExpansionSink& sink_;
  int nesting_;
  std::vector<Frame> frames_;
  std::size_t use_ = 0;  // where, in the text itself, the macro stands whose expansion is being read
};

}  // namespace

std::size_t end_of_quotes(std::string_view text, std::size_t start) {
  for (std::size_t i = start + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '"') return i + 1;
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') ++i;
  }
  return start + 1;
}

void expand_macros(std::string_view text, MacroTable& macros, const ExpansionSink& sink, int nesting) {
  Expander(text, macros, sink, nesting).run();
}

}  // namespace barkridge
