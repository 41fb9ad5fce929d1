#include "lsystem/preprocessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "lsystem/characters.h"
#include "lsystem/macro_expander.h"
#include "lsystem/preprocessor_condition.h"

namespace barkridge {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr int kMaxIncludeDepth = 64;

/// A file's text without comments, joined lines and carriage returns, and where its bytes stand in the file.
struct CleanText {
  struct Piece {
    std::size_t begin;
    std::size_t source;
  };
  std::string text;
  std::vector<Piece> pieces;

  void append(char byte, std::size_t source) {
    const bool continues = !pieces.empty() && pieces.back().source + (text.size() - pieces.back().begin) == source;
    if (!continues) pieces.push_back({text.size(), source});
    text += byte;
  }
  std::size_t source_of(std::size_t offset) const {
    const auto after = std::upper_bound(pieces.begin(), pieces.end(), offset,
                                        [](std::size_t value, const Piece& piece) { return value < piece.begin; });
    if (after == pieces.begin()) return 0;
    const Piece& piece = *(after - 1);
    return piece.source + (offset - piece.begin);
  }
};

std::size_t length_of_joined_line(std::string_view text, std::size_t i) {
  if (text.substr(i).starts_with("\\\n")) return 2;
  return text.substr(i).starts_with("\\\r\n") ? 3 : 0;
}

/// Replaces a comment by a blank. The newlines inside stay, as in cpfg, so that a statement cannot go on after a
/// comment of several lines. Returns the position after it, or `npos` if it does not end.
std::size_t clean_block_comment(std::string_view text, std::size_t start, CleanText& clean) {
  const std::size_t end = text.find("*/", start + 2);
  if (end == std::string_view::npos) return end;
  for (std::size_t i = start; i < end; ++i) {
    if (text[i] == '\n') clean.append('\n', i);
  }
  clean.append(' ', end);
  return end + 2;
}

std::size_t end_of_line_comment(std::string_view text, std::size_t i) {
  while (i < text.size() && text[i] != '\n') i += std::max<std::size_t>(1, length_of_joined_line(text, i));
  return std::min(i, text.size());
}

struct Conditional {
  std::size_t offset;  // of the directive that opened it, in the clean text
  bool enclosing_active;
  bool active;
  bool taken;
  bool else_seen = false;
};

/// A line that holds a directive: its name, what follows, and where both stand in the clean text.
struct Directive {
  std::string_view name;
  std::string_view rest;
  std::size_t name_offset = 0;
  std::size_t rest_offset = 0;
};

constexpr std::array<std::string_view, 13> kDirectives{"define",  "undef",  "include", "if",    "ifdef",
                                                       "ifndef",  "elif",   "else",    "endif", "error",
                                                       "warning", "pragma", "line"};

std::string_view leading_name(std::string_view text) {
  std::size_t end = 0;
  if (!text.empty() && is_name_start(text[0])) {
    while (end < text.size() && is_name_character(text[end])) ++end;
  }
  return text.substr(0, end);
}

class Preprocessor {
 public:
  Preprocessor(const std::map<std::string, std::string>& overrides, const Notify& listener)
      : overrides_(overrides), listener_(listener) {}

  SourceText run(std::string_view text, const std::string& file) {
    read(std::string(text), file, 0);
    for (const auto& [name, value] : overrides_) {
      if (!overridden_.contains(name)) {
        throw InputError(fmt::format("{}: `{}` cannot be set: the file has no `#define {}`{}", file, name, name,
                                     names_to_choose_from()));
      }
    }
    return std::move(out_);
  }

 private:
  struct File {
    SourceText::FileId id;
    int depth;
    CleanText clean;
    std::vector<Conditional> conditionals;

    bool active() const { return conditionals.empty() || conditionals.back().active; }
  };

  SourceLocation place(const File& file, std::size_t offset) const {
    return out_.place_in_file(file.id, file.clean.source_of(offset));
  }
  [[noreturn]] void fail(const File& file, std::size_t offset, const std::string& message) const {
    throw InputError(place(file, offset), message);
  }

  std::string names_to_choose_from() const {
    std::string names;
    for (const auto& [name, macro] : macros_) {
      if (!macro.takes_arguments && !macro.body.empty()) names += (names.empty() ? "" : ", ") + name;
    }
    return names.empty() ? "" : "; it defines " + names;
  }

  void spend(const File& file, std::size_t offset, std::size_t bytes) {
    spent_ += bytes;
    if (spent_ > kMaxBytes) {
      throw LimitError(place(file, offset),
                       fmt::format("includes and macros make the L-system longer than {} MB", kMaxBytes >> 20));
    }
  }

  void read(std::string text, const std::string& name, int depth) {
    if (text.empty() || text.back() != '\n') text += '\n';
    File file{out_.add_file(name, std::move(text)), depth, {}, {}};
    clean(file);
    spend(file, 0, file.clean.text.size());
    const std::string_view all = file.clean.text;
    std::size_t block = 0;  // start of the text that has not been expanded yet
    for (std::size_t line = 0; line < all.size();) {
      const std::size_t end = all.find('\n', line) + 1;
      Directive directive;
      const bool is_directive = parse_directive(all.substr(line, end - 1 - line), line, directive);
      if (is_directive || !file.active()) {
        expand_block(file, block, line);
        if (is_directive) obey(file, directive, end);
        block = end;
      }
      line = end;
    }
    expand_block(file, block, all.size());
    if (!file.conditionals.empty()) fail(file, file.conditionals.back().offset, "this conditional lacks its `#endif`");
  }

  void clean(File& file) {
    const std::string& text = out_.file_text(file.id);
    for (std::size_t i = 0; i < text.size();) {
      const std::string_view rest = std::string_view(text).substr(i);
      if (const std::size_t length = length_of_joined_line(text, i); length > 0) {
        i += length;
      } else if (rest.starts_with("/*")) {
        const std::size_t end = clean_block_comment(text, i, file.clean);
        if (end == std::string::npos) {
          throw InputError(out_.place_in_file(file.id, i), "this comment lacks its `*/`");
        }
        i = end;
      } else if (rest.starts_with("//")) {
        i = end_of_line_comment(text, i);
      } else if (rest.starts_with("\r\n")) {
        ++i;
      } else {
        const std::size_t end = text[i] == '"' ? end_of_quotes(text, i) : i + 1;
        for (; i < end; ++i) file.clean.append(text[i], i);
      }
    }
    if (file.clean.text.empty() || file.clean.text.back() != '\n') file.clean.append('\n', text.size() - 1);
  }

  static bool parse_directive(std::string_view line, std::size_t line_offset, Directive& directive) {
    std::size_t i = 0;
    const auto skip_blanks = [&] {
      while (i < line.size() && is_blank(line[i])) ++i;
    };
    skip_blanks();
    if (i == line.size() || line[i] != '#') return false;
    ++i;
    skip_blanks();
    directive.name_offset = line_offset + i;
    directive.name = leading_name(line.substr(i));
    const bool is_marker = i < line.size() && is_digit(line[i]);
    if (is_marker) directive.name = "line";
    if (std::find(kDirectives.begin(), kDirectives.end(), directive.name) == kDirectives.end()) return false;
    if (!is_marker) i += directive.name.size();
    skip_blanks();
    directive.rest_offset = line_offset + i;
    directive.rest = trim(line.substr(i));
    return true;
  }

  /// `next_line` is where the line after the directive begins.
  void obey(File& file, const Directive& directive, std::size_t next_line) {
    const std::string_view name = directive.name;
    if (name == "if" || name == "ifdef" || name == "ifndef") return open_conditional(file, directive);
    if (name == "elif" || name == "else" || name == "endif") return change_conditional(file, directive);
    if (!file.active()) return;
    if (name == "define") define(file, directive);
    if (name == "undef") macros_.erase(std::string(name_of(file, directive)));
    if (name == "include") include(file, directive);
    if (name == "line") mark_line(file, directive, next_line);
    if (name == "error") fail(file, directive.name_offset, "#error " + std::string(directive.rest));
    if (name == "warning") {
      notify(listener_, message_at(place(file, directive.name_offset), std::string(directive.rest)));
    }
  }

  std::string_view name_of(const File& file, const Directive& directive) const {
    const std::string_view name = leading_name(directive.rest);
    if (name.empty()) fail(file, directive.rest_offset, fmt::format("expected a name after #{}", directive.name));
    return name;
  }

  void open_conditional(File& file, const Directive& directive) {
    const bool enclosing = file.active();
    bool holds = false;
    if (enclosing) {
      holds = directive.name == "if" ? evaluate(file, directive)
                                     : macros_.contains(name_of(file, directive)) == (directive.name == "ifdef");
    }
    file.conditionals.push_back({directive.name_offset, enclosing, enclosing && holds, holds});
  }

  void change_conditional(File& file, const Directive& directive) {
    if (file.conditionals.empty()) fail(file, directive.name_offset, fmt::format("#{} without #if", directive.name));
    if (directive.name == "endif") return file.conditionals.pop_back();
    Conditional& top = file.conditionals.back();
    if (top.else_seen) fail(file, directive.name_offset, fmt::format("#{} after #else", directive.name));
    const bool may_take = top.enclosing_active && !top.taken;
    const bool is_else = directive.name == "else";
    top.active = may_take && (is_else || evaluate(file, directive));
    top.taken = top.taken || top.active;
    top.else_seen = is_else;
  }

  bool evaluate(File& file, const Directive& directive) {
    std::string expanded;
    ExpansionSink sink = sink_for(file, directive.rest_offset);
    sink.copied = [&](char byte, std::size_t) { expanded += byte; };
    sink.expanded = [&](std::string_view text, std::size_t) { expanded += text; };
    expand_macros(without_defined(directive.rest), macros_, sink);
    return condition_holds(expanded, place(file, directive.rest_offset));
  }

  /// `defined NAME` and `defined(NAME)` become 1 or 0.
  std::string without_defined(std::string_view condition) const {
    std::string result;
    while (!condition.empty()) {
      const std::string_view word = leading_name(condition);
      if (word != "defined") {
        const std::size_t length = std::max<std::size_t>(1, word.size());
        result += condition.substr(0, length);
        condition.remove_prefix(length);
        continue;
      }
      condition = trim(condition.substr(word.size()));
      const bool parenthesis = condition.starts_with("(");
      if (parenthesis) condition = trim(condition.substr(1));
      const std::string_view name = leading_name(condition);
      condition = trim(condition.substr(name.size()));
      if (parenthesis && condition.starts_with(")")) condition.remove_prefix(1);
      result += macros_.contains(name) ? " 1 " : " 0 ";
    }
    return result;
  }

  void define(File& file, const Directive& directive) {
    const std::string name(name_of(file, directive));
    std::string_view rest = directive.rest.substr(name.size());
    Macro macro;
    if (rest.starts_with("(")) {
      macro.takes_arguments = true;
      rest = parse_parameters(file, directive, rest, macro);
    }
    macro.body = std::string(trim(rest));
    if (const auto override = overrides_.find(name); override != overrides_.end()) {
      if (macro.takes_arguments) {
        fail(file, directive.rest_offset, fmt::format("`{}` cannot be set: it is a macro with arguments", name));
      }
      macro.body = override->second;
      overridden_.insert(name);
    }
    const auto old = macros_.find(name);
    if (old != macros_.end() && old->second.body != macro.body) {
      notify(listener_, message_at(place(file, directive.rest_offset), fmt::format("`{}` is redefined", name)));
    }
    macros_[name] = std::move(macro);
  }

  std::string_view parse_parameters(const File& file, const Directive& directive, std::string_view rest,
                                    Macro& macro) const {
    const std::size_t close = rest.find(')');
    if (close == std::string_view::npos) fail(file, directive.rest_offset, "the macro's parameters lack their `)`");
    std::string_view list = trim(rest.substr(1, close - 1));
    while (!list.empty()) {
      const std::string_view parameter = leading_name(list);
      list = trim(list.substr(parameter.size()));
      const bool comma = list.starts_with(",");
      if (comma) list = trim(list.substr(1));
      if (parameter.empty() || comma == list.empty()) {
        fail(file, directive.rest_offset, "a macro's parameters are names with commas between them");
      }
      macro.parameters.emplace_back(parameter);
    }
    return rest.substr(close + 1);
  }

  void include(const File& file, const Directive& directive) {
    if (directive.rest.starts_with("<lpfg")) {
      fail(file, directive.rest_offset, "this is an L+C program for lpfg; only cpfg's language is supported yet");
    }
    const std::size_t close = directive.rest.find('"', 1);
    if (!directive.rest.starts_with("\"") || close == std::string_view::npos) {
      fail(file, directive.rest_offset, "expected a file name in double quotes after #include");
    }
    if (file.depth >= kMaxIncludeDepth) {
      fail(file, directive.rest_offset,
           fmt::format("#include is nested more than {} deep; does the file include itself?", kMaxIncludeDepth));
    }
    std::string path(directive.rest.substr(1, close - 1));
    const std::string& includer = out_.file_name(file.id);
    if (const std::size_t slash = includer.rfind('/'); slash != std::string::npos && !path.starts_with("/")) {
      path = includer.substr(0, slash + 1) + path;
    }
    std::string text;
    try {
      text = read_file(path, kMaxBytes);
    } catch (const IoError& error) {
      fail(file, directive.rest_offset, error.what());
    }
    read(std::move(text), path, file.depth + 1);
  }

  void mark_line(File& file, const Directive& directive, std::size_t next_line) {
    int line = 0;
    const char* const begin = directive.rest.data();
    const auto [end, error] = std::from_chars(begin, begin + directive.rest.size(), line);
    if (error != std::errc()) fail(file, directive.rest_offset, "expected a line number");
    std::string_view name = trim(directive.rest.substr(static_cast<std::size_t>(end - begin)));
    name = name.size() > 1 && name[0] == '"' ? name.substr(1, name.find('"', 1) - 1) : std::string_view();
    out_.mark_line(file.id, file.clean.source_of(next_line), line,
                   name.empty() ? place(file, directive.name_offset).file : std::string(name));
  }

  ExpansionSink sink_for(File& file, std::size_t base) {
    ExpansionSink sink;
    sink.fail = [this, &file, base](std::size_t offset, const std::string& message) {
      fail(file, base + offset, message);
    };
    sink.spend = [this, &file, base](std::size_t bytes) { spend(file, base, bytes); };
    return sink;
  }

  void expand_block(File& file, std::size_t begin, std::size_t end) {
    if (begin >= end || !file.active()) return;
    ExpansionSink sink = sink_for(file, begin);
    sink.copied = [&](char byte, std::size_t offset) {
      out_.append(byte, file.id, file.clean.source_of(begin + offset));
    };
    sink.expanded = [&](std::string_view text, std::size_t offset) {
      out_.append_expansion(text, file.id, file.clean.source_of(begin + offset));
    };
    expand_macros(std::string_view(file.clean.text).substr(begin, end - begin), macros_, sink);
  }

  const std::map<std::string, std::string>& overrides_;
  const Notify& listener_;
  std::set<std::string> overridden_;
  MacroTable macros_;
  SourceText out_;
  std::size_t spent_ = 0;
};

}  // namespace

SourceText preprocess(std::string_view text, const std::string& file, const std::map<std::string, std::string>& defines,
                      const Notify& listener) {
  return Preprocessor(defines, listener).run(text, file);
}

}  // namespace barkridge
