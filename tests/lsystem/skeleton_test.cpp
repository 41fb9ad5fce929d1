#include <catch2/catch.hpp>

#include <map>
#include <random>

#include "base/error.h"
#include "lsystem/skeleton.h"
#include "lsystem/turtle.h"

using namespace barkridge;

namespace {

const std::string kHeader = "# barkridge skeleton 1\n";

Skeleton read(const std::string& lines) { return read_skeleton_table(kHeader + lines, "test.skel"); }

/// "line:column: message" of the error that reading ends with.
std::string mistake(const std::string& text) {
  try {
    read_skeleton_table(text, "test.skel");
  } catch (const InputError& error) {
    return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) + ": " + error.message();
  }
  return "none";
}

Internode internode(InternodeId parent, const Vec3& base, const Vec3& tip, double base_radius, double tip_radius) {
  return {base, tip, base_radius, tip_radius, parent, 0, 0};
}

}  // namespace

TEST_CASE("a table has a header and a line an internode") {
  Skeleton skeleton;
  skeleton.internodes.push_back(internode(kNoInternode, {0, 0, 0}, {0, 1.5, 0}, 0.25, 0.2));
  skeleton.internodes.push_back(internode(0, {0, 1.5, 0}, {1.0 / 3, 2e10, -1e-12}, 0.2, 0.1));
  CHECK(write_skeleton_table(skeleton) ==
        "# barkridge skeleton 1\n0 -1 0 0 0 0 1.5 0 0.25 0.2\n1 0 0 1.5 0 0.333333333 2e+10 -1e-12 0.2 0.1\n");
}

TEST_CASE("a table that was written reads the same to nine digits and writes the same") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-100, 100), radius(1e-3, 5);
  Skeleton skeleton;
  for (int i = 0; i < 1000; ++i) {
    const InternodeId parent = i == 0 ? kNoInternode : static_cast<InternodeId>(random() % static_cast<unsigned>(i));
    const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
    skeleton.internodes.push_back(internode(parent, point(), point(), radius(random), radius(random)));
  }
  const std::string text = write_skeleton_table(skeleton);
  const Skeleton again = read_skeleton_table(text, "test.skel");
  CHECK(write_skeleton_table(again) == text);
  REQUIRE(again.internodes.size() == 1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    CHECK(again.internodes[i].parent == skeleton.internodes[i].parent);
    CHECK(glm::length(again.internodes[i].tip - skeleton.internodes[i].tip) < 1e-6);
    CHECK(again.internodes[i].base_radius == Approx(skeleton.internodes[i].base_radius).epsilon(1e-8));
  }
}

TEST_CASE("a table that was written has the marks of its internodes again") {
  Skeleton skeleton;
  skeleton.internodes.push_back(internode(kNoInternode, {0, 0, 0}, {0, 2, 0}, 0.25, 0.25));
  skeleton.internodes.push_back(internode(0, {0, 2, 0}, {0, 4, 0}, 0.2, 0.2));
  skeleton.internodes.push_back(internode(0, {0, 2, 0}, {1, 3, 0}, 0.125, 0.125));
  skeleton.internodes.push_back(internode(1, {0, 4, 0}, {0, 4.5, 0}, 0.1, 0.1));
  skeleton.ridges = {{0.25, 0.0625}, {0.5, 0.125}};
  skeleton.internodes[2].ridge = 1;
  skeleton.internodes[3].ridge = 0;
  skeleton.cut_ends.push_back({2, {0.6, 0.8, 0}, 2.5});
  skeleton.scars.push_back({3, {1.5, 0.25, 0.5}});
  const std::string text = write_skeleton_table(skeleton);
  CHECK(text.starts_with("# barkridge skeleton 2\n"));
  CHECK(text.ends_with("ridge 2 0.5 0.125\nridge 3 0.25 0.0625\ncut 2 0.6 0.8 0 2.5\nscar 3 1.5 0.25 0.5\n"));
  const Skeleton again = read_skeleton_table(text, "test.skel");
  CHECK(write_skeleton_table(again) == text);
  CHECK(again.ridges.at(static_cast<std::size_t>(again.internodes.at(2).ridge)) == Ridge{0.5, 0.125});
  CHECK(again.ridges.at(static_cast<std::size_t>(again.internodes.at(3).ridge)) == Ridge{0.25, 0.0625});
  CHECK(again.internodes[1].ridge == kNoRidge);
  REQUIRE(again.cut_ends.size() == 1);
  CHECK(again.cut_ends[0].internode == 2);
  CHECK(glm::distance(again.cut_ends[0].normal, Vec3(0.6, 0.8, 0)) < 1e-9);
  CHECK(again.cut_ends[0].splinters == 2.5);
  REQUIRE(again.scars.size() == 1);
  CHECK(again.scars[0].internode == 3);
  CHECK(again.scars[0].shape.depth == 0.25);
}

TEST_CASE("mistakes in a table's marks are found where they are") {
  const std::string table = "# barkridge skeleton 2\n0 -1 0 0 0 0 1 0 1 1\n1 0 0 1 0 0 2 0 1 1\n";
  CHECK(mistake(table + "cut 1 0 1 0 0\n") == "none");
  CHECK(mistake(table + "saw 1\n") == "4:1: expected ridge, cut or scar, not `saw`");
  CHECK(mistake(table + "ridge 1 0.5\n") == "4:1: expected 3 numbers after `ridge`: id width swelling");
  CHECK(mistake(table + "scar 7 1 1 1\n") == "4:6: no internode has the id 7");
  CHECK(mistake(table + "scar 1 1 x 1\n") == "4:10: expected a number for depth, not `x`");
  CHECK(mistake(table + "cut 1 1 0 0 0\n") == "4:7: a cut's normal is at most 60 degrees from the axis");
  CHECK(mistake(table + "cut 1 0 1 0 21\n") == "4:13: expected splinters from 0 to 20");
  CHECK(mistake(table + "scar 1 -1 0.3 0.3\n").starts_with("4:1: "));
  CHECK_THROWS_AS(read_skeleton_table(table + "cut 0 0 1 0 0\n", "test.skel"), InputError);
  CHECK_THROWS_AS(read_skeleton_table(table + "cut 1 0 1 0 0\nscar 1 1 0.3 0.3\n", "test.skel"), InputError);
  CHECK(mistake(kHeader + "cut 0 0 1 0 0\n").starts_with("2:"));
}

TEST_CASE("ids may be any numbers, and comments, blanks and empty lines are passed over") {
  const Skeleton skeleton =
      read("# ids\n\n 700 -1 0 0 0 0 1 0 1 1\n\t20  700 0 1 0 0 2 0 1 0.5\r\n5 20 0 2 0 0 3 0 .5 .25");
  REQUIRE(skeleton.internodes.size() == 3);
  CHECK(skeleton.internodes[0].parent == kNoInternode);
  CHECK(skeleton.internodes[1].parent == 0);
  CHECK(skeleton.internodes[2].parent == 1);
  CHECK(skeleton.internodes[2].tip_radius == 0.25);
}

TEST_CASE("the thickest child continues its parent's order") {
  const Skeleton skeleton = read(
      "0 -1 0 0 0 0 1 0 3 3\n"
      "1 0 0 1 0 1 2 0 1 1\n"
      "2 0 0 1 0 0 2 0 2 2\n"
      "3 0 0 1 0 -1 2 0 2 2\n"
      "4 1 1 2 0 1 3 0 1 1\n"
      "5 2 0 2 0 0 3 0 2 2\n");
  const std::vector<int> orders{0, 1, 0, 1, 1, 0};
  for (std::size_t i = 0; i < orders.size(); ++i) CHECK(skeleton.internodes[i].order == orders[i]);
}

TEST_CASE("mistakes in tables are found where they are") {
  CHECK(mistake("") == "1:1: expected `# barkridge skeleton 1` in the first line");
  CHECK(mistake("0 -1 0 0 0 0 1 0 1 1\n") == "1:1: expected `# barkridge skeleton 1` in the first line");
  CHECK(mistake("# barkridge skeleton 3\n") ==
        "1:1: this version of the skeleton table is not known; only versions 1 and 2 are");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1 0 1\n") == "2:19: expected 10 fields, `r1` and what follows are missing");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1 0 1 1 1\n") == "2:22: expected 10 fields, not more");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1y 0 1 1\n") == "2:14: expected a number for y1, not `1y`");
  CHECK(mistake(kHeader + "0 -1 nan 0 0 0 1 0 1 1\n") == "2:6: x0 is not a number (nan)");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 inf 0 1 1\n") == "2:14: y1 is infinite");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1e999 0 1 1\n") == "2:14: y1 is out of range");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1 0 0 1\n") == "2:18: the radius is zero");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1 0 1 -1\n") == "2:20: the radius is negative");
  CHECK(mistake(kHeader + "x -1 0 0 0 0 1 0 1 1\n") == "2:1: expected an integer for id, not `x`");
  CHECK(mistake(kHeader + "-2 -1 0 0 0 0 1 0 1 1\n") == "2:1: an internode's id must not be negative");
  CHECK(mistake(kHeader + "0 0 0 0 0 0 1 0 1 1\n") ==
        "2:3: the parent 0 has not been listed; parents come before children");
  CHECK(mistake(kHeader + "0 -1 0 0 0 0 1 0 1 1\n0 -1 0 0 0 0 1 0 1 1\n") == "3:1: the id 0 is used twice");
}

namespace {

/// A chain of internodes, long enough to be read in several parts at once; `id(i)` is what the table calls the i-th.
template <typename Id>
std::vector<std::string> long_table(Id id) {
  std::vector<std::string> lines;
  for (int i = 0; i < 20000; ++i) {
    const std::string parent = i == 0 ? "-1" : std::to_string(id(i - 1));
    const std::string base = std::to_string(i), tip = std::to_string(i + 1);
    lines.push_back(std::to_string(id(i)) + ' ' + parent + " 0 " + base + " 0 0 " + tip + " 0 1 1");
  }
  return lines;
}
const auto itself = [](int i) { return i; };

std::string joined(const std::vector<std::string>& lines) {
  std::string text = kHeader;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

}  // namespace

TEST_CASE("a long table keeps its order, whatever its ids and however many comments stand in it") {
  const auto backwards = [](int i) { return 1000000 - 3 * i; };
  std::vector<std::string> commented = long_table(backwards);
  for (std::size_t i = 0; i < commented.size(); i += 7) commented[i] += "\n# a comment\n\n";
  for (const std::string& text : {joined(long_table(itself)), joined(long_table(backwards)), joined(commented)}) {
    const Skeleton skeleton = read_skeleton_table(text, "test.skel");
    REQUIRE(skeleton.internodes.size() == 20000);
    bool in_order = true;
    for (int i = 0; i < 20000; ++i) {
      const Internode& internode = skeleton.internodes[static_cast<std::size_t>(i)];
      in_order = in_order && internode.base.y == i && internode.parent == i - 1;
    }
    CHECK(in_order);
  }
}

TEST_CASE("of several mistakes in a long table the first is reported") {
  const std::vector<std::string> right = long_table(itself);
  const auto with = [&](const std::map<std::size_t, std::string>& lines) {
    std::vector<std::string> wrong = right;
    for (const auto& [i, line] : lines) wrong[i] = line;
    return mistake(joined(wrong));
  };
  const std::string unreadable = "x", orphan = "50000 40000 0 0 0 0 1 0 1 1", repeated = "7 6 0 0 0 0 1 0 1 1";
  CHECK(with({{15000, unreadable}, {19999, unreadable}}) ==
        "15002:2: expected 10 fields, `parent` and what follows are missing");
  CHECK(with({{12000, orphan}, {12001, unreadable}, {19000, repeated}}) ==
        "12002:7: the parent 40000 has not been listed; parents come before children");
  CHECK(with({{11999, repeated}, {12001, unreadable}, {100, "# left out"}}) ==
        "103:5: the parent 100 has not been listed; parents come before children");
  CHECK(with({{11999, repeated}, {12000, unreadable}, {19000, orphan}}) == "12001:1: the id 7 is used twice");
  CHECK(with({{3, "50000 19999 0 0 0 0 1 0 1 1"}}) ==
        "5:7: the parent 19999 has not been listed; parents come before children");
}

TEST_CASE("a table without internodes is an empty skeleton") {
  CHECK(read("").internodes.empty());
  CHECK(write_skeleton_table({}) == kHeader);
}

TEST_CASE("children are found by their parents") {
  Skeleton skeleton;
  for (const InternodeId parent : {-1, 0, 0, 1, -1, 0}) {
    skeleton.internodes.push_back(internode(parent, {0, 0, 0}, {0, 1, 0}, 1, 1));
  }
  const ChildTable table = child_table(skeleton);
  const auto children = [&](std::size_t i) {
    return std::vector<InternodeId>(table.children.begin() + table.first[i],
                                    table.children.begin() + table.first[i + 1]);
  };
  CHECK(children(0) == std::vector<InternodeId>{1, 2, 5});
  CHECK(children(1) == std::vector<InternodeId>{3});
  CHECK(children(2).empty());
  CHECK(children(6) == std::vector<InternodeId>{0, 4});
}

TEST_CASE("internodes of zero length go, and their children and organs move to their parents") {
  Skeleton skeleton;
  skeleton.internodes.push_back(internode(kNoInternode, {0, 0, 0}, {0, 0, 0}, 1, 1));
  skeleton.internodes.push_back(internode(0, {0, 0, 0}, {0, 1, 0}, 1, 1));
  skeleton.internodes.push_back(internode(1, {0, 1, 0}, {0, 1, 0}, 1, 1));
  skeleton.internodes.push_back(internode(2, {0, 1, 0}, {0, 1, 0}, 1, 1));
  skeleton.internodes.push_back(internode(3, {0, 1, 0}, {0, 2, 0}, 1, 1));
  for (const InternodeId id : {0, 3, 4}) {
    Organ organ;
    organ.internode = id;
    skeleton.organs.push_back(organ);
  }
  skeleton.dropped_internodes = 10;
  const Skeleton kept = without_zero_lengths(skeleton);
  REQUIRE(kept.internodes.size() == 2);
  CHECK(kept.dropped_internodes == 13);
  CHECK(kept.internodes[0].parent == kNoInternode);
  CHECK(kept.internodes[1].parent == 0);
  CHECK(kept.organs[0].internode == kNoInternode);
  CHECK(kept.organs[1].internode == 0);
  CHECK(kept.organs[2].internode == 1);
}

TEST_CASE("a table's internodes of zero length are dropped and counted") {
  const Skeleton skeleton = read("0 -1 0 0 0 0 1 0 1 1\n1 0 0 1 0 0 1 0 1 1\n2 1 0 1 0 0 2 0 1 1\n");
  CHECK(skeleton.internodes.size() == 2);
  CHECK(skeleton.dropped_internodes == 1);
  CHECK(skeleton.internodes[1].parent == 0);
}
