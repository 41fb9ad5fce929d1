#include "lsystem/lst.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/error.h"

using namespace barkridge;

namespace {

std::string mistake(const std::string& text) {
  try {
    read_lst(text, "a.lst");
  } catch (const InputError& error) {
    return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) + ": " + error.message();
  }
  return "none";
}

const std::string kHeader = "LST 0.1\n";

bool near(const Vec3& a, const Vec3& b) { return glm::distance(a, b) < 1e-12; }

}  // namespace

TEST_CASE("the report's sample is a trunk with two forks") {
  // Angles in the plane add up, from +y towards -x: 0.3, then -1 and -0.6 further in the first bracket.
  const Skeleton skeleton = read_lst(
      "LST 0.1\n\nRotRel3f(0.3, 0, 0, 1)\nCylinder(1, 1, 10)\nMovRel3f(0, 10, 0)\n"
      "SB()\nRotRel3f(-1.0, 0, 0, 1)\nCylinder(1, 0.5, 5)\nMovRel3f(0, 5, 0)\n"
      "RotRel3f(-0.6, 0, 0, 1)\nCylinder(1, 1, 5)\nEB()\n"
      "SB()\nRotRel3f(1.0, 0, 0, 1)\nCylinder(1, 1, 5)\nEB()\n"
      "MovRel3f(0, 5, 0)\nRotRel3f(0.6, 0, 0, 1)\nCylinder(1, 1, 10)\n",
      "a.lst");
  const auto along = [](double angle, double length) { return length * Vec3(-std::sin(angle), std::cos(angle), 0); };
  const std::vector<Internode>& i = skeleton.internodes;
  REQUIRE(i.size() == 5);
  CHECK(i[0].base == Vec3(0));
  CHECK(near(i[0].tip, along(0.3, 10)));
  CHECK(i[1].base == i[0].tip);  // exactly, in spite of rounding
  CHECK(near(i[1].tip, along(0.3, 10) + along(-0.7, 5)));
  CHECK(i[2].base == i[1].tip);
  CHECK(near(i[2].tip, i[1].tip + along(-1.3, 5)));
  CHECK(near(i[3].tip, along(0.3, 10) + along(1.3, 5)));
  CHECK(near(i[4].base, along(0.3, 15)));  // a gap, as written
  CHECK(near(i[4].tip, along(0.3, 15) + along(0.9, 10)));
  CHECK(i[1].base_radius == 1);
  CHECK(i[1].tip_radius == 0.5);
  const auto parents = [&] { return std::vector{i[0].parent, i[1].parent, i[2].parent, i[3].parent, i[4].parent}; };
  CHECK(parents() == std::vector<InternodeId>{-1, 0, 1, 0, 0});
  CHECK(std::vector{i[0].order, i[1].order, i[2].order, i[3].order, i[4].order} == std::vector{0, 1, 1, 1, 0});
}

TEST_CASE("an LST axis needs no length and turns in the turtle's own frame") {
  const double quarter = std::numbers::pi / 2;
  const std::string turns = "RotRel3f(" + std::to_string(quarter) + ", 0, 0, 1e300) RotRel3f(" +
                            std::to_string(quarter) + ", 1e-300, 0, 0) Cylinder(1,1,2)";
  // About z the frame's x becomes +y and its y -x; about that x, y then becomes the frame's z, which still is +z.
  CHECK(glm::distance(read_lst(kHeader + turns, "a.lst").internodes.at(0).tip, Vec3(0, 0, 2)) < 1e-5);
}

TEST_CASE("an LST cylinder of no length is dropped and counted") {
  const Skeleton skeleton = read_lst(kHeader + "Cylinder(1,1,0)\nCylinder(1,1,1)\n", "a.lst");
  CHECK(skeleton.internodes.size() == 1);
  CHECK(skeleton.internodes[0].parent == kNoInternode);
  CHECK(skeleton.dropped_internodes == 1);
  CHECK(read_lst(kHeader, "a.lst").internodes.empty());
}

TEST_CASE("mistakes in LST files are found where they are") {
  CHECK(mistake("") == "1:1: expected `LST 0.1` in the first line");
  CHECK(mistake("LST 0.2\n") == "1:5: only version 0.1 of the LST format is known");
  CHECK(mistake(kHeader + "SB()\nEB()\nEB()\n") == "4:1: this `EB` has no `SB`");
  CHECK(mistake(kHeader + "SB()\nSB()\nEB()\n") == "2:1: this `SB` has no `EB`");
  CHECK(mistake(kHeader + " Cone(1)") == "2:2: expected SB, EB, MovRel3f, RotRel3f or Cylinder, not `Cone`");
  CHECK(mistake(kHeader + "?") == "2:1: expected SB, EB, MovRel3f, RotRel3f or Cylinder, not `?`");
  CHECK(mistake(kHeader + "Cylinder(1, 1)") == "2:14: expected `,` after the end radius of `Cylinder`, not `)`");
  CHECK(mistake(kHeader + "MovRel3f(1, , 1)") == "2:13: expected a number for y of `MovRel3f`, not `,`");
  CHECK(mistake(kHeader + "MovRel3f(1, 1, 1") ==
        "2:17: expected `)` at the end of `MovRel3f`, not the end of the file");
  CHECK(mistake(kHeader + "MovRel3f(1, 1, 1e999)") == "2:16: expected a finite number for z of `MovRel3f`");
  CHECK(mistake(kHeader + "MovRel3f(nan, 1, 1)") == "2:10: expected a finite number for x of `MovRel3f`");
  CHECK(mistake(kHeader + "Cylinder(0, 1, 1)") == "2:10: the radius is zero");
  CHECK(mistake(kHeader + "Cylinder(1, -1, 1)") == "2:13: the radius is negative");
  CHECK(mistake(kHeader + "Cylinder(1, 1, -1)") == "2:16: the length is negative");
  CHECK(mistake(kHeader + "RotRel3f(1, 0, 0, 0)") == "2:13: the axis is zero: expected a direction");
  CHECK(mistake(kHeader + "MovRel3f(1e308, 0, 0)\nMovRel3f(1e308, 0, 0)") ==
        "3:1: this leads out of all finite places");
  CHECK(mistake(kHeader + "SB(1)") == "2:4: expected `)` at the end of `SB`, not `1`");
}
