#pragma once
// A model as a short program for a stack machine. One walk over it evaluates a batch of points, bounds a box, or writes
// the program that is left of it on a box; the three read alike.

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "blobtree/field.h"
#include "blobtree/primitive.h"
#include "blobtree/warp.h"

namespace barkridge {

struct FieldInstruction {
  enum class Op : std::uint8_t {
    // These push a field.
    kZero,
    kCone,       // index: cones
    kFadedCone,  // index: faded_cones
    kOther,      // index: others
    // This changes the top.
    kNegate,
    // These replace the top `count` fields by one, in the order in which they were pushed.
    kSum,
    kRicci,  // index: exponents
    kUnion,
    kIntersection,
    kDifference,  // count 2
    kContact,     // index: contacts
    // Between these the points are warped.
    kEnterWarp,  // index: warps
    kLeaveWarp,  // index: warps
  };
  Op op = Op::kZero;
  std::uint32_t count = 0;
  std::uint32_t index = 0;

  bool operator==(const FieldInstruction&) const = default;
};

/// What the instructions of a model and of all its restrictions refer to. Immutable and shared.
struct FieldProgramData {
  struct ConeData {
    Cone cone;
    Vec3 axis;  ///< unit; anything for a sphere, whose length is 0
    double length, taper;
    Box support;
  };
  struct FadedConeData {
    FadedCone cone;
    FadedConeFrame frame;
    Box support;
  };
  struct OtherData {
    std::variant<Disc, Ring, Polygon> primitive;
    Box support;
  };
  std::vector<ConeData> cones;
  std::vector<FadedConeData> faded_cones;
  std::vector<OtherData> others;
  std::vector<double> exponents;
  std::vector<ContactShape> contacts;
  std::vector<Warp> warps;
};

struct FieldProgram {
  std::shared_ptr<const FieldProgramData> data;
  std::vector<FieldInstruction> code;  ///< leaves one field on the stack; empty for the zero field
};

/// Largest numbers of fields and of sets of points that a program holds at once.
struct FieldProgramDepth {
  std::size_t fields = 0;
  std::size_t warps = 0;
};
FieldProgramDepth depth_of(const FieldProgram& program);

/// Writes the program of a checked tree. Operands that need a deep stack come first, so that a skeleton's tree of N
/// internodes needs a stack of about log N however long its axes are.
FieldProgram compile_program(const BlobTree& tree);

/// Evaluates all points of a span. `gradients` is empty or as long as `points`.
void evaluate(const FieldProgram& program, const FieldProgramDepth& depth, std::span<const Vec3> points,
              std::span<double> values, std::span<Vec3> gradients);

/// Bounds on a box; and, where `rest` is given, the program of all that can matter there, whose values and gradients in
/// the box are those of `program` to the bit.
FieldBounds bound(const FieldProgram& program, const Box& box, std::vector<FieldInstruction>* rest = nullptr);

}  // namespace barkridge
