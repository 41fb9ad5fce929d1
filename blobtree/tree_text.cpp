// The text form of trees: written and read without recursion, by the one list of kinds and members in node_fields.h.

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <set>
#include <string>

#include "base/error.h"
#include "blobtree/node_fields.h"

namespace barkridge {

namespace {

// ---- Writing.

std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(int x) { return fmt::format("{}", x); }
std::string text_of(double x) { return fmt::format("{}", x); }
std::string text_of(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }
std::string text_of(const Mat3& m) {  // by rows
  return text_of(Vec3(m[0][0], m[1][0], m[2][0])) + "  " + text_of(Vec3(m[0][1], m[1][1], m[2][1])) + "  " +
         text_of(Vec3(m[0][2], m[1][2], m[2][2]));
}
std::string text_of(const std::vector<Vec3>& points) {
  std::string text;
  for (const Vec3& p : points) text += (text.empty() ? "" : "; ") + text_of(p);
  return text;
}

std::string head_of(const Node& node) {
  return std::visit(
      [](const auto& what) {
        std::string arguments;
        for_each_field(what, [&](const char* name, const auto& member) {
          arguments += fmt::format("{}{} = {}", arguments.empty() ? "" : ", ", name, text_of(member));
        });
        std::string head(kNodeName<std::decay_t<decltype(what)>>);
        return arguments.empty() ? head : head + '(' + arguments + ')';
      },
      node.what);
}

// Deeper nodes are not indented further, so that the text of a deep tree stays linear in its size.
constexpr std::size_t kDeepestIndent = 40;

// ---- Reading.

class Parser {
 public:
  Parser(std::string_view text, const std::string& file, int first_line)
      : text_(text), file_(file), first_line_(first_line) {}

  BlobTree run() {
    skip_blank();
    if (at_end()) return {};
    // Open nodes from the root to the present one; their children collect until the brace closes.
    do {
      const std::size_t start = at_;
      if (!open_.empty() && take('}')) {
        close_node();
      } else {
        Node node = head();
        if (take('{')) {
          open_.push_back({std::move(node), start});
        } else {
          finish(std::move(node), start);
        }
      }
      skip_blank();
      if (at_end() && !open_.empty()) fail(open_.back().start, "this node's '{' is never closed: expected '}'");
    } while (!open_.empty());
    if (!at_end()) fail(at_, "expected the end: a tree has one root");
    return std::move(tree_);
  }

 private:
  struct OpenNode {
    Node node;
    std::size_t start;
  };

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    SourceLocation where = locate(text_, offset, file_);
    where.line += first_line_ - 1;
    throw InputError(where, message);
  }

  bool at_end() const { return at_ >= text_.size(); }

  void skip_blank() {
    while (!at_end()) {
      const char c = text_[at_];
      if (c == '#') {
        while (!at_end() && text_[at_] != '\n') ++at_;
      } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        ++at_;
      } else {
        break;
      }
    }
  }

  bool take(char c) {
    skip_blank();
    if (at_end() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  void expect(char c, const char* after) {
    if (!take(c)) fail(at_, fmt::format("expected '{}' {}", c, after));
  }

  std::string_view name(const char* what) {
    skip_blank();
    const std::size_t start = at_;
    while (!at_end() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) ++at_;
    if (at_ == start) fail(start, fmt::format("expected {}", what));
    return text_.substr(start, at_ - start);
  }

  void read(bool& value) {
    skip_blank();
    const std::size_t start = at_;
    const std::string_view word = name("true or false");
    if (word != "true" && word != "false") fail(start, "expected true or false");
    value = word == "true";
  }
  void read(int& value) { read_number(value, "expected an integer"); }
  void read(double& value) {
    const std::size_t start = read_number(value, "expected a number");
    if (!std::isfinite(value)) fail(start, "expected a finite number");
  }
  void read(Vec3& v) {
    read(v.x);
    read(v.y);
    read(v.z);
  }
  void read(Mat3& m) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) read(m[column][row]);
    }
  }
  void read(std::vector<Vec3>& points) {
    points.clear();
    do {
      read(points.emplace_back());
    } while (take(';'));
  }

  // Returns where it stands.
  template <typename Number>
  std::size_t read_number(Number& value, const char* expected) {
    skip_blank();
    const std::size_t start = at_;
    const char* const begin = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const char* const digits = begin < end && *begin == '+' ? begin + 1 : begin;
    const auto [stop, error] = std::from_chars(digits, end, value);
    if (error == std::errc::result_out_of_range) fail(start, "this number is out of range");
    if (error != std::errc()) fail(start, expected);
    at_ += static_cast<std::size_t>(stop - begin);
    return start;
  }

  template <typename What>
  void arguments(What& what) {
    if (!take('(')) return;
    if (take(')')) return;
    std::set<std::string_view> given;
    do {
      skip_blank();
      const std::size_t start = at_;
      const std::string_view key = name("the name of an argument");
      std::string known;
      bool found = false;
      for_each_field(what, [&](const char* field, auto& member) {
        known += (known.empty() ? "" : ", ") + std::string(field);
        if (found || key != field) return;
        found = true;
        if (!given.insert(field).second) fail(start, fmt::format("'{}' is given twice", key));
        expect('=', "after the argument's name");
        read(member);
      });
      if (!found) {
        fail(start, known.empty() ? fmt::format("a {} has no arguments", kNodeName<What>)
                                  : fmt::format("a {} has no '{}'; it has {}", kNodeName<What>, key, known));
      }
    } while (take(','));
    expect(')', "or ',' after an argument");
  }

  template <typename... Kinds>
  bool make(std::string_view kind, std::variant<Kinds...>& what, std::string& known) {
    bool found = false;
    const auto try_kind = [&]<typename What>(What value) {
      known += (known.empty() ? "" : ", ") + std::string(kNodeName<What>);
      if (found || kind != kNodeName<What>) return;
      found = true;
      arguments(value);
      what = std::move(value);
    };
    (try_kind(Kinds{}), ...);
    return found;
  }

  Node head() {
    skip_blank();
    const std::size_t start = at_;
    const std::string_view kind = name("the kind of a node");
    Node node;
    std::string known;
    if (!make(kind, node.what, known))
      fail(start, fmt::format("no node is called '{}'; expected one of {}", kind, known));
    return node;
  }

  void close_node() {
    OpenNode done = std::move(open_.back());
    open_.pop_back();
    finish(std::move(done.node), done.start);
  }

  void finish(Node node, std::size_t start) {
    try {
      check(node);
    } catch (const InputError& error) {
      fail(start, error.message());
    }
    const NodeId id = tree_.add(std::move(node.what), std::move(node.children));
    if (!open_.empty()) open_.back().node.children.push_back(id);
  }

  std::string_view text_;
  const std::string& file_;
  int first_line_;
  std::size_t at_ = 0;
  std::vector<OpenNode> open_;
  BlobTree tree_;
};

}  // namespace

std::string to_string(const BlobTree& tree) {
  if (tree.nodes.empty()) return {};
  std::string text;
  struct Task {
    NodeId node;
    std::size_t level;
    bool closes;
  };
  std::vector<Task> tasks{{tree.root, 0, false}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    text.append(std::min(2 * task.level, kDeepestIndent), ' ');
    if (task.closes) {
      text += "}\n";
      continue;
    }
    const Node& node = tree.nodes[task.node];
    text += head_of(node);
    if (node.children.empty()) {
      text += '\n';
      continue;
    }
    text += " {\n";
    tasks.push_back({task.node, task.level, true});
    for (std::size_t i = node.children.size(); i-- > 0;) tasks.push_back({node.children[i], task.level + 1, false});
  }
  return text;
}

BlobTree parse_tree(std::string_view text, const std::string& file, int first_line) {
  return Parser(text, file, first_line).run();
}

}  // namespace barkridge
