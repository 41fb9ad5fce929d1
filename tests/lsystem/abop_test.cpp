// Trees of "The Algorithmic Beauty of Plants", against measures that cpfg itself printed.

#include <catch2/catch.hpp>

#include <map>
#include <string>

#include "base/output_file.h"
#include "lsystem/derive.h"
#include "lsystem/turtle.h"

using namespace barkridge;

namespace {

struct Measures {
  std::size_t count;
  double length;
  Box box;
};

Measures measure(const std::string& name, const std::map<std::string, std::string>& defines) {
  const std::string path = std::string(BARKRIDGE_SOURCE_DIR) + "/tests/lsystem/" + name;
  const Grammar grammar = parse_grammar(read_file(path), path, defines);
  const Skeleton skeleton = interpret(derive(grammar), &grammar);
  Measures measures{skeleton.internodes.size(), 0, {}};
  for (const Internode& internode : skeleton.internodes) {
    measures.length += glm::length(internode.tip - internode.base);
    measures.box = unite(unite(measures.box, internode.base), internode.tip);
  }
  return measures;
}

void check(const Measures& measured, double length, const Box& box) {
  CHECK(measured.count == 1023);
  CHECK(measured.length == Approx(length).margin(0.005));
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(measured.box.lo[axis] == Approx(box.lo[axis]).margin(0.0006));
    CHECK(measured.box.hi[axis] == Approx(box.hi[axis]).margin(0.0006));
  }
}

using Defines = std::map<std::string, std::string>;

}  // namespace

TEST_CASE("Honda's monopodial trees have the size they have in cpfg") {
  check(measure("honda.l", {}), 113.33, {{-1.786, 0, -2.599}, {1.664, 6.513, 1.712}});
  check(measure("honda.l", Defines{{"R2", "0.9"}}), 445.06, {{-3.191, 0, -4.582}, {3.917, 6.513, 3.836}});
  check(measure("honda.l", Defines{{"R2", "0.8"}}), 286.57, {{-2.381, 0, -3.465}, {2.821, 6.513, 2.919}});
  check(measure("honda.l", Defines{{"R2", "0.7"}, {"A0", "30"}, {"A2", "-30"}}), 181.59,
        {{-1.565, 0, -2.144}, {1.734, 6.513, 1.663}});
}

TEST_CASE("Aono's and Kunii's sympodial trees have the size they have in cpfg") {
  check(measure("aono_kunii.l", {}), 181.59, {{-2.240, 0, -2.495}, {3.021, 6.424, 3.599}});
  check(measure("aono_kunii.l", Defines{{"A1", "10"}, {"A2", "60"}}), 181.59,
        {{-2.139, 0, -2.698}, {2.766, 6.165, 3.326}});
  check(measure("aono_kunii.l", Defines{{"R2", "0.8"}, {"A1", "20"}, {"A2", "50"}}), 286.57,
        {{-2.820, 0, -3.235}, {3.063, 5.269, 3.680}});
  check(measure("aono_kunii.l", Defines{{"R2", "0.8"}, {"A1", "35"}, {"A2", "35"}}), 286.57,
        {{-3.224, 0, -3.418}, {2.866, 3.625, 3.039}});
}
