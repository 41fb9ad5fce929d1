#include "lsystem/growth.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "lsystem/derive.h"
#include "lsystem/grammar.h"
#include "lsystem/turtle.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

namespace {

// A stem that forks at every step, from random angles, and twigs of two internodes a step; the third lateral of a
// branch waits for three steps before it grows, and every lateral is shed when it is six steps old.
const char* const kPlant = R"(Lsystem: 1
derivation length: 12
start: {srand(3);}
axiom: !(0.6)F(0.5)A(0.5,0)
A(w,n) : n<9 --> !(w)F(1)[C(0)&(40+nran(0,9))D(w*0.5,3*(n==2))]/(137.5)-(nran(0,5))A(w*0.8,n+1)
D(w,n) : n>0 --> D(w,n-1)
D(w,n) : * --> !(w)F(0.7)#(w*0.9)F(0.4)[+(50)B(w*0.5)]-(10)D(w*0.8,0)
B(w) : w>0.05 --> !(w)F(0.5)B(w*0.7)
C(n) : n<6 --> C(n+1)
C(n) : * --> %
endlsystem
)";

// The steps in which it has shed nothing yet.
const int kStepsBeforeShedding = 7;

Skeleton plant_at(std::optional<double> time, TurtleOptions options, const char* text = kPlant) {
  const Grammar grammar = parse_grammar(text, "test.l");
  DeriveOptions derivation;
  derivation.time = options.growth.time = time;
  derivation.keep_cuts = true;
  return interpret(derive(grammar, derivation), &grammar, options);
}

std::vector<Internode> visible(const Skeleton& skeleton) {
  std::vector<Internode> internodes = skeleton.internodes;
  std::erase_if(internodes, [](const Internode& a) { return glm::distance(a.base, a.tip) < 1e-2; });
  return internodes;
}

// Growth of every kind: by drawn widths and by pipes.
std::vector<TurtleOptions> kinds_of_growth() {
  std::vector<TurtleOptions> kinds(4);
  kinds[0].growth.elongation_steps = 3;
  kinds[0].growth.thickening_steps = 5;
  kinds[1].growth.curve = GrowthCurve::kPower;
  kinds[1].growth.exponent = 1;
  kinds[1].growth.opening_steps = 4;
  kinds[2].growth.elongation_steps = 2.5;
  kinds[2].growth.opening_steps = 1;
  kinds[2].growth.thickening_steps = 2;
  kinds[2].growth.pipe.tip_radius = 0.01;
  kinds[3].growth.curve = GrowthCurve::kPower;
  kinds[3].growth.exponent = 1.5;
  kinds[3].growth.thickening_steps = 3.5;
  kinds[3].growth.pipe = {2.4, 0.02};
  return kinds;
}

double base_radius_at(double time, const TurtleOptions& options) {
  return plant_at(time, options).internodes.front().base_radius;
}

// Of the branch that an axiom `axiom` sheds in step 4, five steps after the start.
Skeleton shed_from(const std::string& axiom, const GrowthOptions& growth = {}) {
  const std::string text = "Lsystem: 1\nderivation length: 5\naxiom: " + axiom +
                           "\nC(n) : n<2 --> C(n+1)\nC(n) : * --> %\nX --> GXX\nendlsystem\n";
  TurtleOptions options;
  options.growth = growth;
  return plant_at(5, options, text.c_str());
}

}  // namespace

TEST_CASE("sizes follow age by the cubic curve or by a power, from 0 at birth to 1") {
  GrowthOptions options;
  options.time = 3;
  // Step 3 came at time 2, so that it is one step old.
  CHECK(grown_part(3, 2, options) == Approx(0.5));
  CHECK(grown_part(3, 4, options) == Approx(0.0625 * 2.5));
  CHECK(grown_part(3, 1, options) == 1);
  CHECK(grown_part(3, 0, options) == 1);
  CHECK(grown_part(4, 2, options) == 0);
  CHECK(grown_part(1, 2, options) == 1);
  options.curve = GrowthCurve::kPower;
  options.exponent = 3;
  CHECK(grown_part(3, 2, options) == Approx(0.125));
  options.time.reset();
  CHECK(grown_part(3, 2, options) == 1);
}

TEST_CASE("a derivation takes the steps that have begun by its time, and each time continues the one before") {
  const std::string text = "Lsystem: 1\nderivation length: 3\naxiom: A\nA --> F(ran(1))A\nendlsystem\n";
  const auto word_at = [&](double time) {
    DeriveOptions options;
    options.time = time;
    return to_string(derive(parse_grammar(text, "test.l"), options));
  };
  CHECK(word_at(0) == "A");
  CHECK(word_at(1e-9) == grown(text, 1));
  CHECK(word_at(1) == grown(text, 1));
  CHECK(word_at(1.5) == grown(text, 2));
  CHECK(word_at(3) == grown(text));
  CHECK(word_at(1e300) == grown(text));
  CHECK(word_at(2.5).starts_with(word_at(2).substr(0, word_at(2).size() - 1)));
}

TEST_CASE("GetTime is the time, or without one the number of steps") {
  const std::string text = "Lsystem: 1\nderivation length: 4\naxiom: A\nA --> B(GetTime(0))A\nendlsystem\n";
  DeriveOptions options;
  options.time = 1.25;
  CHECK(to_string(derive(parse_grammar(text, "test.l"), options)) == "B(1.25)B(1.25)A");
  options.time.reset();
  options.steps = 2;
  CHECK(to_string(derive(parse_grammar(text, "test.l"), options)) == "B(2)B(2)A");
  CHECK(grown(text, {}) == "B(4)B(4)B(4)B(4)A");
}

TEST_CASE("a homomorphism can draw lengths of its own for every time") {
  const std::string text =
      "Lsystem: 1\nderivation length: 4\naxiom: A\nA --> B(Q-1)A\nhomomorphism\nB(t) --> F((GetTime(0)-t)*2)\n"
      "endlsystem\n";
  TurtleOptions options;
  options.growth.elongation_steps = 0;
  const Skeleton skeleton = plant_at(1.5, options, text.c_str());
  REQUIRE(skeleton.internodes.size() == 2);
  CHECK(skeleton.internodes[0].tip.y == Approx(3));
  CHECK(skeleton.internodes[1].tip.y == Approx(4));
}

TEST_CASE("internodes, turns and organs have the sizes of their ages") {
  const char* const text = "Lsystem: 1\nderivation length: 4\naxiom: A\nA --> F(2)+(60)A@O(3)\nendlsystem\n";
  TurtleOptions options;
  options.growth.elongation_steps = 2;
  options.growth.opening_steps = 4;
  const Skeleton skeleton = plant_at(1.5, options, text);
  REQUIRE(skeleton.internodes.size() == 2);
  const auto curve = [](double x) { return x * x * (3 - 2 * x); };
  const Internode& old = skeleton.internodes[0];
  const Internode& young = skeleton.internodes[1];
  CHECK(old.tip.y == Approx(2 * curve(0.75)));
  CHECK(glm::distance(young.base, young.tip) == Approx(2 * curve(0.25)));
  const double turned = 60 * curve(0.375) * M_PI / 180;
  CHECK(glm::normalize(young.tip - young.base).x == Approx(-std::sin(turned)));
  REQUIRE(skeleton.organs.size() == 2);
  CHECK(skeleton.organs[0].size == Approx(3 * curve(0.25)));
  CHECK(skeleton.organs[1].size == Approx(3 * curve(0.75)));
}

TEST_CASE("just before and just after every step a plant is the same") {
  for (TurtleOptions options : kinds_of_growth()) {
    for (int step = 1; step < kStepsBeforeShedding; ++step) {
      for (const double moment : {1e-3, 1e-5}) {
        CAPTURE(options.growth.thickening_steps, step, moment);
        const Skeleton after_step = plant_at(step + moment, options);
        const std::vector<Internode> before = visible(plant_at(step - moment, options)), after = visible(after_step);
        REQUIRE(before.size() == after.size());
        REQUIRE(before.size() > static_cast<std::size_t>(step));
        double moved = 0, thickened = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
          moved = std::max(
              {moved, glm::distance(before[i].base, after[i].base), glm::distance(before[i].tip, after[i].tip)});
          thickened = std::max({thickened, std::fabs(before[i].base_radius - after[i].base_radius),
                                std::fabs(before[i].tip_radius - after[i].tip_radius)});
        }
        CHECK(moved < 20 * moment);
        CHECK(thickened < 2 * moment);
        for (const Internode& internode : after_step.internodes) {
          if (internode.birth_step == step + 1) CHECK(internode.base_radius < 1e-3);
        }
      }
    }
  }
}

TEST_CASE("without a time a plant is the one that it becomes in the end") {
  for (const TurtleOptions& options : kinds_of_growth()) {
    const Skeleton in_the_end = plant_at(1000, options), grown_up = plant_at({}, options);
    REQUIRE(in_the_end.internodes.size() == grown_up.internodes.size());
    for (std::size_t i = 0; i < grown_up.internodes.size(); ++i) {
      CHECK(in_the_end.internodes[i].tip == grown_up.internodes[i].tip);
      CHECK(in_the_end.internodes[i].base_radius == grown_up.internodes[i].base_radius);
      CHECK(in_the_end.internodes[i].tip_radius == grown_up.internodes[i].tip_radius);
    }
  }
}

TEST_CASE("drawn widths come with age and fit together where internodes meet") {
  TurtleOptions options;
  options.growth.thickening_steps = 4;
  const auto curve = [](double age) { return age / 4 * (age / 4) * (3 - age / 2); };
  const char* const one = "Lsystem: 1\nderivation length: 9\naxiom: !(2)A\nA --> F(1)A\nendlsystem\n";
  const Skeleton stem = plant_at(2.5, options, one);
  REQUIRE(stem.internodes.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(stem.internodes[i].base_radius == Approx(std::max(1e-3, curve(2.5 - static_cast<double>(i)))));
    CHECK(stem.internodes[i].tip_radius == Approx(i < 2 ? curve(1.5 - static_cast<double>(i)) : 1e-3));
  }
  // Two internodes a step.
  const char* const two = "Lsystem: 1\nderivation length: 9\naxiom: !(2)A\nA --> F(1)F(1)A\nendlsystem\n";
  const Skeleton jointed = plant_at(2.5, options, two);
  for (std::size_t i = 1; i < jointed.internodes.size(); ++i) {
    CHECK(jointed.internodes[i].base_radius == jointed.internodes[i - 1].tip_radius);
  }
}

TEST_CASE("by the pipe model the exponent's powers of radii add up, and the trunk counts its tips") {
  for (const double exponent : {1.0, 2.0, 2.49}) {
    TurtleOptions options;
    options.growth.pipe = {exponent, 0.01};
    const Grammar grammar = parse_grammar(kPlant, "test.l");
    DeriveOptions derivation;
    derivation.steps = kStepsBeforeShedding;
    const Skeleton skeleton = interpret(derive(grammar, derivation), &grammar, options);
    std::map<InternodeId, double> carried;
    for (const Internode& internode : skeleton.internodes) {
      CHECK(internode.base_radius == internode.tip_radius);
      carried[internode.parent] += std::pow(internode.base_radius, exponent);
    }
    int tips = 0;
    for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
      const auto found = carried.find(static_cast<InternodeId>(i));
      if (found == carried.end()) {
        ++tips;
        CHECK(skeleton.internodes[i].tip_radius == Approx(0.01));
      } else {
        CHECK(std::pow(skeleton.internodes[i].tip_radius, exponent) == Approx(found->second));
      }
    }
    CHECK(tips > 10);
    CHECK(skeleton.internodes.front().base_radius == Approx(0.01 * std::pow(tips, 1 / exponent)));
  }
}

TEST_CASE("a trunk never becomes thinner, not even where branches are shed") {
  for (TurtleOptions options : kinds_of_growth()) {
    double before = 0;
    for (int i = 1; i <= 150; ++i) {
      const double radius = base_radius_at(0.1 * i, options);
      CAPTURE(options.growth.thickening_steps, i);
      CHECK(radius >= before * (1 - 1e-12));
      before = radius;
    }
  }
}

TEST_CASE("a branch that is shed is recorded where it stood, as it was") {
  const Skeleton skeleton = shed_from("!(0.2)F(3)[C(0)+(90)!(0.1)F(2)[&(9)F]]F(1)");
  CHECK(skeleton.internodes.size() == 2);
  REQUIRE(skeleton.shed_branches.size() == 1);
  const ShedBranch& shed = skeleton.shed_branches.front();
  CHECK(shed.parent == 0);
  CHECK(shed.base == Vec3(0, 3, 0));
  CHECK(glm::distance(shed.heading, Vec3(-1, 0, 0)) < 1e-12);
  CHECK(shed.radius == Approx(0.05));
  // C(2) stands there after two steps, % after three; the fourth step, at time 3, cuts.
  CHECK(shed.age == 2);
}

TEST_CASE("records of shed branches keep their places while the word grows around them") {
  const Skeleton skeleton = shed_from("!(0.2)XF(3)[X[F]C(0)+(90)!(0.1)F(2)]F(1)[C(0)F]X");
  REQUIRE(skeleton.shed_branches.size() == 2);
  const auto parent = static_cast<std::size_t>(skeleton.shed_branches[0].parent);
  CHECK(glm::distance(skeleton.shed_branches[0].base, skeleton.internodes[parent].tip) == 0);
  CHECK(glm::distance(skeleton.shed_branches[0].heading, Vec3(-1, 0, 0)) < 1e-12);
  // X becomes 31 segments in five steps.
  CHECK(skeleton.shed_branches[0].base == Vec3(0, 65, 0));
  CHECK(skeleton.shed_branches[1].base == Vec3(0, 35, 0));
}

TEST_CASE("records go with a branch that is shed later, and a cut of nothing leaves none") {
  CHECK(shed_from("F(3)[C(-1)F[C(0)F(2)]]F(1)").shed_branches.size() == 1);
  CHECK(shed_from("F(3)[C(-1)F[C(0)F(2)]F]F(1)").shed_branches.size() == 1);
  CHECK(shed_from("F(3)[FC(0)]F(1)").shed_branches.empty());
  CHECK(shed_from("F(3)[C(0)+(3)]F(1)").shed_branches.empty());
}

TEST_CASE("the pipes of a shed branch stay in what carried them") {
  GrowthOptions growth;
  growth.pipe = {2, 0.1};
  const Skeleton skeleton = shed_from("F(3)[C(0)F(2)[+F][-F]]F(1)", growth);
  REQUIRE(skeleton.shed_branches.size() == 1);
  CHECK(skeleton.shed_branches[0].radius == Approx(0.1 * std::sqrt(2)));
  CHECK(skeleton.internodes[0].tip_radius == Approx(0.1 * std::sqrt(3)));
  CHECK(skeleton.internodes[1].tip_radius == Approx(0.1));
}
