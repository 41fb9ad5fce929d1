#include "study/models.h"

#include <fmt/format.h>

namespace barkridge {

namespace {

// A stem that carries laterals in pairs, which carry laterals again, all joints planar; with `stubs`, every second
// internode of the laterals also bears what a shed twig leaves.
std::string pruned_shoot(int nodes, bool stubs) {
  return fmt::format(
      "#define NODES {}\n"
      "Lsystem: shoot\n"
      "derivation length: NODES\n"
      "axiom: A(0.35,0.1)\n"
      "A(l,w) --> !(2*w)F(l)[+(52)B(l*0.8,w*0.5)][-(48)B(l*0.8,w*0.5)]/(90)A(l*0.97,w*0.93)\n"
      "B(l,w) --> !(2*w)F(l){}[+(45)T(l*0.7,w*0.6)]/(180)B(l*0.9,w*0.88)\n"
      "T(l,w) --> !(2*w)F(l)\n"
      "endlsystem\n",
      nodes, stubs ? "[-(70)!(1.2*w)F(w*1.6)]" : "");
}

// Forks all the way up, each in a plane square to the one before; twigs keep a share of the tree's size that pictures
// can show.
std::string forked_tree(int steps) {
  return fmt::format(
      "#define STEPS {}\n"
      "Lsystem: tree\n"
      "derivation length: STEPS\n"
      "axiom: A(1,0.1)\n"
      "A(l,w) --> !(2*w)F(l)[+(30)/(90)A(l*0.88,w*0.72)][-(34)/(90)A(l*0.84,w*0.69)]\n"
      "endlsystem\n",
      steps);
}

}  // namespace

std::vector<StudyModel> study_models(std::size_t most_internodes) {
  std::vector<StudyModel> models{
      {"scars", "with stubs of shed twigs, as the thesis' model with scars", pruned_shoot(12, true)},
      {"no_scars", "the thesis' model without scars", pruned_shoot(10, false)}};
  for (const int steps : {8, 11, 14, 17}) {
    const std::size_t internodes = (std::size_t{1} << steps) - 1;
    if (internodes > most_internodes) break;
    models.push_back(
        {fmt::format("tree_{}", internodes), fmt::format("a tree of {} internodes", internodes), forked_tree(steps)});
  }
  return models;
}

}  // namespace barkridge
