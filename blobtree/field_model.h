#pragma once
// A whole model, compiled: flat primitives in an order that is coherent in space, the operators above them, and what
// finds those that matter in a region, at a cost that does not depend on the rest.

#include <memory>
#include <variant>
#include <vector>

#include "blobtree/box_hierarchy.h"
#include "blobtree/field_program.h"
#include "blobtree/warp.h"

namespace barkridge {

inline constexpr std::uint32_t kNoOperator = ~std::uint32_t{0};

/// A node above the primitives. Nested sums are one; every primitive stands in a sum, or in two.
struct FieldOperator {
  FieldInstruction::Op op;  ///< kEnterWarp for a warp
  bool is_kept = false;     ///< whether it changes even a lone operand
  std::uint8_t rank = 0;    ///< 0 if it is its parent's first operand, else 1
  std::uint8_t kept_rank = 0;
  std::uint32_t index = 0;          ///< as an instruction's
  std::uint32_t operand_count = 0;  ///< of a sum: at least 1
  std::uint32_t parent = kNoOperator;
  std::uint32_t depth = 0;
  /// At least by how much all displacements from here up can increase a field.
  float gain = 1;
  /// The nearest operator above that changes even a lone operand, and the rank of what leads to it from here.
  std::uint32_t kept_above = kNoOperator;
};

inline constexpr std::uint32_t kNoPlace = ~std::uint32_t{0};

/// Where a primitive stands among the operands of all sums, in the order of programs. One that stands in two operands
/// of a union, as an internode does in the sums of two junctions, is there once and has a second place.
struct PrimitivePlaces {
  std::uint32_t first = 0;
  std::uint32_t second = kNoPlace;
};

/// Finds the lowest common ancestor of places by a range minimum over those of neighbours.
class AncestorTable {
 public:
  /// Of neighbours `i` and `i + 1`: the operator and its depth.
  void build(std::vector<std::uint32_t> ancestors, const std::vector<FieldOperator>& operators);
  /// The deepest operator above both places, `first < last`.
  std::uint32_t common(std::uint32_t first, std::uint32_t last, const std::vector<FieldOperator>& operators) const;
  std::size_t memory() const;

 private:
  static constexpr std::size_t kBlock = 32;
  std::vector<std::uint32_t> ancestors_;
  std::vector<std::vector<std::uint32_t>> highest_;  // over 2^k blocks from each block on
};

struct FieldModel {
  struct Other {
    std::uint32_t primitive = 0;  ///< its number among all primitives
    std::variant<Disc, Ring, Polygon> shape;
    Box support;
  };

  // By primitive. Of an other primitive than a cone, the record means nothing.
  std::vector<ConeRecord> cones;
  std::vector<ConeKind> kinds;
  std::vector<NodeId> nodes;            ///< what each is in the tree; of equal nodes the first
  std::vector<PrimitivePlaces> places;  ///< by rising first places; empty if no primitive has two, and so its number
  BoxHierarchy supports;

  // By place.
  std::vector<std::uint32_t> sums;  ///< the operator that each stands in
  AncestorTable ancestors;

  std::vector<FieldOperator> operators;
  std::vector<Other> others;  ///< by primitive
  std::vector<double> exponents;
  std::vector<ContactShape> contacts;
  std::vector<Warp> warps;
  std::vector<Displacement> displacements;

  Box support;
  /// The scale is the power of two that brings the model's largest extent between 1/2 and 1.
  ModelUnits units;
  /// Enclose all values and gradients anywhere.
  FieldBounds bounds;
  /// Whether no operator makes more of its operands than their sum, but for the gain of displacements. Only contact
  /// with large swelling does.
  bool is_below_sum = true;
  /// Whether some displacement stands under a warp.
  bool warps_noise = false;
  /// Whether some primitives are subtracted.
  bool takes_away = false;

  const Other* other_at(std::uint32_t primitive) const;
  PrimitivePlaces places_of(std::uint32_t primitive) const {
    return places.empty() ? PrimitivePlaces{primitive} : places[primitive];
  }
  /// The sum of a primitive's first place. Above a second one are the same warps, and nothing that takes away.
  std::uint32_t sum_of(std::uint32_t primitive) const { return sums[places_of(primitive).first]; }
  std::size_t memory() const;
};

/// Compiles a checked tree. Operands that need a deep stack come first, so that the program of a skeleton's tree of N
/// internodes needs a stack of about log N, however long its axes are. Cost: N log N.
std::shared_ptr<const FieldModel> compile_model(const BlobTree& tree);

/// Writes the program of some primitives, given in rising order: the model without all others, and without sums that
/// cannot be the largest as they are but one operand of another. Cost: in proportion to the program.
void assemble(const FieldModel& model, std::span<const std::uint32_t> primitives, FieldProgram& program);

/// Whether any operator above a sum moves its primitives.
bool is_warped(const FieldModel& model, std::uint32_t sum);

/// Whether the primitives of a sum can only lower the field: they stand where something is taken away.
bool only_takes_away(const FieldModel& model, std::uint32_t sum);

/// Where all warps above a sum move what a box wraps; `box_in(frame)` gives the box in a bend's frame, or in the world
/// where there is none.
template <typename BoxIn>
Box box_in_world(const FieldModel& model, std::uint32_t sum, const BoxIn& box_in) {
  Box box;
  bool is_moved = false;
  for (std::uint32_t at = model.operators[sum].kept_above; at != kNoOperator; at = model.operators[at].kept_above) {
    if (model.operators[at].op != FieldInstruction::Op::kEnterWarp) continue;
    const Warp& warp = model.warps[model.operators[at].index];
    if (is_moved) {
      box = warp.support(box);
    } else if (const Warp::BendData* bend = warp.bend()) {
      box = bend->frame.to_world(warp.bent_support(box_in(&bend->frame)));
    } else {
      box = warp.support(box_in(nullptr));
    }
    is_moved = true;
  }
  return is_moved ? box : box_in(nullptr);
}

}  // namespace barkridge
