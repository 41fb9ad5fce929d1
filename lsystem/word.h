#pragma once
// The string of modules that an L-system rewrites.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace barkridge {

struct MachineState;  // private to this room: lsystem/machine.h

/// A string of parametric modules in two flat arrays: symbols with the place of their parameters.
struct Word {
  struct Module {
    char symbol = 0;
    std::uint8_t parameter_count = 0;
    std::uint16_t birth_step = 0;  ///< the derivation step that made it, saturating
    std::uint32_t first_parameter = 0;
  };
  /// A branch that `%` removed, whole with what it had lost before, and where it stood.
  struct Cut {
    std::size_t position = 0;  ///< before this module
    std::int32_t step = 0;     ///< the derivation step that removed it
    std::shared_ptr<const Word> branch;
  };
  std::vector<Module> modules;
  std::vector<float> parameters;
  /// By position; only where the derivation was asked to keep them.
  std::vector<Cut> cuts;
  /// What the L-system's variables and random streams held after the last step, for the homomorphism to go on from;
  /// null for a word that was not derived.
  std::shared_ptr<const MachineState> state;

  std::span<const float> parameters_of(const Module& module) const {
    return {parameters.data() + module.first_parameter, module.parameter_count};
  }
};

/// cpfg's text form: modules in order, parameters by `%g`, a line break before a module once 70 characters, not
/// counting commas, are on the line. No newline at the end.
std::string to_string(const Word& word);

/// Reads cpfg's text form: a symbol is any visible ASCII character, white space between modules is ignored. Throws
/// `InputError` for other characters, parameters that are not finite floats and brackets without their partner.
Word parse_word(std::string_view text, const std::string& file);

}  // namespace barkridge
