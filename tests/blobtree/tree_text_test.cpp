#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/blobtree/random_trees.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

std::string message_of(const std::string& text) {
  try {
    parse_tree(text, "scene.toml", 10);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("every tree's text reads back as an equal tree") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const BlobTree tree = random_tree(seed, 1 + static_cast<int>(seed) % 25);
    const BlobTree again = parse_tree(to_string(tree), "text");
    // Nodes may be numbered anew; a second round must change nothing at all.
    CHECK(to_string(again) == to_string(tree));
    CHECK(parse_tree(to_string(again), "text") == again);
  }
}

TEST_CASE("arguments left out have their defaults and comments are ignored") {
  const BlobTree tree = parse_tree("# a model\nsum {\n  cone(tip = 0 2 0)  # one\n  contact { ring() }\n}\n", "text");
  BlobTree expected;
  const NodeId cone = expected.add(Cone{Vec3(0), Vec3(0, 2, 0), 1, 1});
  const NodeId ring = expected.add(Ring{});
  const NodeId contact = expected.add(Contact{}, {ring});
  expected.add(Sum{}, {cone, contact});
  CHECK(tree == expected);
  CHECK(parse_tree("  # nothing\n", "text").nodes.empty());
}

TEST_CASE("mistakes in a tree's text are shown with their place") {
  CHECK(message_of("sum {\n  cne()\n}").find("scene.toml:11:3: no node is called 'cne'") == 0);
  CHECK(message_of("cone(base = 0 x 0)").find("scene.toml:10:15: expected a number") == 0);
  CHECK(message_of("cone(bse = 0 0 0)").find("a cone has no 'bse'; it has base, tip, base_radius, tip_radius") !=
        std::string::npos);
  CHECK(message_of("cone(base_radius = 1, base_radius = 2)").find("given twice") != std::string::npos);
  CHECK(message_of("cone(base_radius = 0)").find("radii must be above zero") != std::string::npos);
  CHECK(message_of("cone(base_radius = -1)").find("radii must be above zero") != std::string::npos);
  CHECK(message_of("cone(base_radius = nan)").find("expected a finite number") != std::string::npos);
  CHECK(message_of("cone(base_radius = 1e999)").find("out of range") != std::string::npos);
  CHECK(message_of("sum {\n cone()\n").find("scene.toml:10:1: this node's '{' is never closed") == 0);
  CHECK(message_of("cone() cone()").find("a tree has one root") != std::string::npos);
  CHECK(message_of("sum { }").find("at least one child") != std::string::npos);
  CHECK(message_of("difference { cone() }").find("at least two children") != std::string::npos);
  CHECK(message_of("bend { cone() cone() }").find("exactly one child") != std::string::npos);
  CHECK(message_of("cone() { cone() }").find("no children") != std::string::npos);
  CHECK(message_of("contact(swelling = 0.4) { cone() }").find("swelling") != std::string::npos);
  CHECK(message_of("polygon(vertices = 0 0 0; 1 0 0)").find("three vertices") != std::string::npos);
  CHECK(message_of("}").find("expected the kind of a node") != std::string::npos);
}

TEST_CASE("a tree's text may nest a hundred thousand deep") {
  std::string text;
  const int depth = 100'000;
  for (int i = 0; i < depth; ++i) text += "sum{";
  text += "cone()";
  text.append(depth, '}');
  const BlobTree tree = parse_tree(text, "text");
  CHECK(tree.nodes.size() == depth + 1);
  CHECK(parse_tree(to_string(tree), "text") == tree);
}

TEST_CASE("trees whose nodes do not form one are refused") {
  BlobTree tree;
  const NodeId cone = tree.add(Cone{});
  tree.add(Sum{}, {cone, cone});
  CHECK_THROWS_AS(check(tree), InputError);
  BlobTree loop;
  loop.add(Sum{}, {0});
  CHECK_THROWS_AS(check(loop), InputError);
  CHECK_THROWS_AS(compile(loop), InputError);
  CHECK_THROWS_AS(reference_field(loop), InputError);
}

TEST_CASE("of several mistakes in a large tree the first node's is reported") {
  const auto mistake = [](const BlobTree& tree) -> std::string {
    try {
      check(tree);
    } catch (const InputError& error) {
      return error.message();
    }
    return "none";
  };
  BlobTree tree;
  for (NodeId i = 0; i < 10000; ++i) i % 2 == 0 ? tree.add(Cone{}) : tree.add(Sum{}, {i - 1});
  CHECK(mistake(tree) == "none");
  tree.nodes[9000].what = Cone{Vec3(0), Vec3(0, 1, 0), -1, 1};
  tree.nodes[8000].what = Ricci{0.5};
  CHECK(mistake(tree) == "ricci: exponent must be at least 1");
  tree.nodes[7001].children = {6998};
  CHECK(mistake(tree) == "node 7001: child 6998 has another parent");
  tree.nodes[2].what = Cone{Vec3(0), Vec3(0, 1, 0), 0, 1};
  CHECK(mistake(tree) == "cone: radii must be above zero");
}
