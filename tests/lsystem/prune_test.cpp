#include "lsystem/prune.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "lsystem/turtle.h"
#include "lsystem/word.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Skeleton drawn(const std::string& word) { return interpret(parse_word(word, "test"), nullptr, {}); }

// Two laterals of order 1 on a trunk of three, the first with a twig of order 2 and two more of its own.
const std::string kPlant = "!(2)F(4)[+(90)!(1)F(2)[+(45)!(0.5)F(1)]F(2)F(2)]F(4)[-(90)!(0.8)F(3)]F(4)";

std::size_t count_selected(const Skeleton& skeleton, const Selection& selection) {
  const Selector selector(skeleton, selection);
  std::size_t count = 0;
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) count += selector.selects(i);
  return count;
}

}  // namespace

TEST_CASE("a selection holds what meets all of its conditions") {
  Skeleton skeleton = drawn(kPlant);
  REQUIRE(skeleton.internodes.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) skeleton.internodes[i].birth_step = static_cast<std::int32_t>(i);
  CHECK(count_selected(skeleton, {}) == 8);
  Selection selection;
  selection.order = {1, 1};
  CHECK(count_selected(skeleton, selection) == 4);
  selection.radius = {0.45, 0.6};
  CHECK(count_selected(skeleton, selection) == 3);
  selection.age = {0, 4};  // born in step 3 or later
  CHECK(count_selected(skeleton, selection) == 2);
  selection.ids = {4, 0};
  CHECK(count_selected(skeleton, selection) == 1);
}

TEST_CASE("a random fraction is drawn by seed and identity") {
  Skeleton skeleton = chain(1, 4000, 0);
  Selection selection;
  selection.fraction = 0.3;
  selection.seed = 5;
  const std::size_t count = count_selected(skeleton, selection);
  CHECK(std::abs(static_cast<double>(count) - 1200) < 5 * std::sqrt(4000 * 0.3 * 0.7));
  const Selector selector(skeleton, selection);
  selection.seed = 6;
  const Selector other(skeleton, selection);
  bool differs = false;
  for (std::size_t i = 0; i < 4000; ++i) differs = differs || selector.selects(i) != other.selects(i);
  CHECK(differs);
  // What was pruned before does not matter: here all gets new numbers.
  std::reverse(skeleton.internodes.begin(), skeleton.internodes.end());
  for (std::size_t i = 0; i < 4000; ++i) skeleton.internodes[i].source = static_cast<InternodeId>(3999 - i);
  CHECK(count_selected(skeleton, selection) == count_selected(chain(1, 4000, 0), selection));
}

TEST_CASE("a cut leaves its share of a branch's length and nothing beyond") {
  CutRule rule;
  rule.branches.order = {1, 1};
  rule.branches.radius = {0.5, 0.5};
  rule.position = 0.5;  // of 2 + 2 + 2
  const Skeleton left = prune(drawn(kPlant), {&rule, 1}, {});
  REQUIRE(left.internodes.size() == 7);
  REQUIRE(left.cut_ends.size() == 1);
  const Internode& cut = left.internodes[static_cast<std::size_t>(left.cut_ends[0].internode)];
  CHECK(glm::distance(cut.base, cut.tip) == Approx(1));
  CHECK(std::abs(cut.tip.x) == Approx(3));
  CHECK(cut.source == 3);
  CHECK(glm::distance(left.cut_ends[0].normal, glm::normalize(cut.tip - cut.base)) < 1e-12);
}

TEST_CASE("a cut keeps its internode's taper, and the first of several counts") {
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0), Vec3(0, 10, 0), 1, 0.5});
  std::vector<CutRule> rules(3);
  rules[0].position = 0.7;
  rules[1].position = 0.4;
  rules[2].position = 0.6;
  const Skeleton left = prune(skeleton, rules, {});
  REQUIRE(left.cut_ends.size() == 1);
  CHECK(left.internodes[0].tip.y == Approx(4));
  CHECK(left.internodes[0].tip_radius == Approx(0.8));
  CHECK(prune(left, {}, {}).internodes[0].tip.y == left.internodes[0].tip.y);
}

TEST_CASE("a cut tilts away from what carries the branch") {
  CutRule rule;
  rule.branches.ids = {4};
  rule.tilt_degrees = 25;
  Skeleton skeleton = drawn(kPlant);
  const Skeleton left = prune(skeleton, {&rule, 1}, {});
  REQUIRE(left.cut_ends.size() == 1);
  const Vec3 axis(-1, 0, 0), trunk(0, 1, 0);
  CHECK(glm::dot(left.cut_ends[0].normal, axis) == Approx(std::cos(25 * kDegree)));
  CHECK(glm::dot(left.cut_ends[0].normal, trunk) == Approx(-std::sin(25 * kDegree)));
}

TEST_CASE("shedding leaves one internode of a branch and a scar, and never takes a root") {
  ScarRule rule;
  rule.shape.width = 1.5;
  const Skeleton left = prune(drawn(kPlant), {}, {&rule, 1});
  REQUIRE(left.scars.size() == 2);
  CHECK(left.internodes.size() == 5);
  CHECK(left.scars[0].shape.width == 1.5);
  CHECK(left.internodes[0].order == 0);
}

TEST_CASE("an L-system marks cuts and scars itself, and the rest of the branch is not drawn") {
  const Skeleton cut = drawn("!(2)F(4)[+(90)F(3)@K(30)F(5)]F(4)");
  REQUIRE(cut.internodes.size() == 3);
  REQUIRE(cut.cut_ends.size() == 1);
  CHECK(cut.cut_ends[0].internode == 1);
  CHECK(cut.cut_ends[0].splinters == 0);
  CHECK(glm::dot(cut.cut_ends[0].normal, Vec3(-1, 0, 0)) == Approx(std::cos(30 * kDegree)));
  const Skeleton torn = drawn("!(2)F(4)[+(90)F(3)@K(0,2.5)]F(4)@K");
  REQUIRE(torn.cut_ends.size() == 2);
  CHECK(torn.cut_ends[0].splinters == 2.5);
  const Skeleton shed = drawn("!(2)F(4)[+(90)!(1)@k(1.2,0.4,0.1)F(3)]F(4)");
  REQUIRE(shed.scars.size() == 1);
  CHECK(shed.internodes.size() == 3);
  CHECK(shed.scars[0].shape.depth == Approx(0.4));
  CHECK(shed.internodes[1].base_radius == 0.5);
  CHECK(shed.internodes[1].order == 1);
}

TEST_CASE("what stands beyond a mark is pruned") {
  const Skeleton left = prune(drawn("!(2)F(4)[+(90)F(3)][-(45)F(2)]@K"), {}, {});
  CHECK(left.internodes.size() == 1);
  CHECK(left.cut_ends.size() == 1);
}

TEST_CASE("numbers out of range are refused by rules and by marks") {
  CutRule cut;
  const auto refused = [&] { CHECK_THROWS_AS(prune(chain(1, 3, 0), {&cut, 1}, {}), InputError); };
  cut.position = 1;
  refused();
  cut = {};
  cut.tilt_degrees = 61;
  refused();
  cut = {};
  cut.splinters = -1;
  refused();
  ScarRule scar;
  scar.shape.stub = 1.5;
  CHECK_THROWS_AS(prune(chain(1, 3, 0), {}, {&scar, 1}), InputError);
  CHECK_THROWS_AS(drawn("@K"), InputError);
  CHECK_THROWS_AS(drawn("F@K(80)"), InputError);
  CHECK_THROWS_AS(drawn("[@k]"), InputError);
  CHECK_THROWS_AS(drawn("F[@k(-1)]"), InputError);
}

TEST_CASE("what growth has shed leaves scars that shrink evenly and are gone when they have healed") {
  Skeleton skeleton = drawn("!(2)F(4)F(4)");
  skeleton.shed_branches = {
      {0, {0, 4, 0}, {1, 0, 0}, 0.4, 3}, {0, {0, 4, 0}, {-1, 0, 0}, 0.3, 8}, {-1, {}, {1, 0, 0}, 1, 0}};
  const Skeleton left = with_scars_of_shed(skeleton, 8, {1, 0.4, 0.2});
  REQUIRE(left.internodes.size() == 3);
  REQUIRE(left.scars.size() == 1);
  CHECK(left.scars[0].internode == 2);
  CHECK(left.scars[0].shape.width == 1);
  CHECK(left.scars[0].shape.depth == Approx(0.4 * 5 / 8));
  CHECK(left.scars[0].shape.stub == Approx(0.2 * 5 / 8));
  const Internode& stub = left.internodes[2];
  CHECK(stub.parent == 0);
  CHECK(stub.order == 1);
  CHECK(stub.base == Vec3(0, 4, 0));
  CHECK(glm::distance(stub.tip, Vec3(stub_length(1, 0.4), 4, 0)) < 1e-12);
  CHECK(stub.tip_radius == 0.4);
  CHECK(with_scars_of_shed(skeleton, 3, {}).scars.empty());
  CHECK_THROWS_AS(with_scars_of_shed(skeleton, 8, {-1, 0, 0}), InputError);
}
