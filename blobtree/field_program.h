#pragma once
// What matters of a model in some region, as a short program for a stack machine. One walk over it evaluates a batch of
// points, another bounds a box and writes the program that is left of it there; the two read alike.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "blobtree/cone_record.h"
#include "blobtree/field.h"
#include "blobtree/ray_bundle.h"
#include "blobtree/ray_search.h"

namespace barkridge {

struct FieldModel;

struct FieldInstruction {
  enum class Op : std::uint8_t {
    // These push a field.
    kZero,
    kCones,  // the sum of `count` cones from `index` on in the program's list
    kOther,  // index: the model's other primitives
    // These change the top.
    kNegate,
    kDisplace,  // index: displacements
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

/// A cone of the model and how to evaluate it.
struct ConeReference {
  std::uint32_t cone : 30;
  std::uint32_t kind : 2;

  ConeReference(std::uint32_t number, ConeKind how) : cone(number), kind(static_cast<std::uint32_t>(how)) {}
};

/// Largest numbers of fields and of sets of points that a program holds at once.
struct FieldProgramDepth {
  std::size_t fields = 0;
  std::size_t warps = 0;
  bool displaces = false;  ///< whether it holds a noise besides
};

struct FieldProgram {
  std::vector<FieldInstruction> code;  ///< leaves one field on the stack; empty for the zero field
  std::vector<ConeReference> cones;

  void clear() {
    code.clear();
    cones.clear();
  }
};

FieldProgramDepth depth_of(const FieldProgram& program);

/// The number of its primitives.
std::size_t primitive_count_of(const FieldProgram& program);

/// Evaluates all points of a span. `gradients` is empty or as long as `points`. Single precision about the nearest of a
/// grid of origins (`ModelUnits`): a point's bits depend on the point only.
void evaluate(const FieldModel& model, const FieldProgram& program, std::span<const Vec3> points,
              std::span<double> values, std::span<Vec3> gradients);

/// What RaySearch finds in the ranges of some rays, in single precision about each one's middle. Returns the rays that
/// have such a point. `bounds` are the program's on all the ranges.
RayLanes search_along(const FieldModel& model, const FieldProgram& program, const FieldBounds& bounds,
                      const RayBundle& bundle, RayLanes rays, const RayRanges& ranges, double tolerance, SearchAim aim,
                      std::array<RayRoot, RayBundle::kWidth>& found);

/// Bounds on a box; and, where `rest` is given, the program of all that can matter there, whose values and gradients in
/// the box are those of `program` to the bit.
FieldBounds bound(const FieldModel& model, const FieldProgram& program, const Box& box, FieldProgram* rest = nullptr);

struct LineMeeting;

/// The same along parts of rays, from what they meet; `program` is that of the primitives they meet.
FieldBounds bound_along(const FieldModel& model, const FieldProgram& program, const LineMeeting& meeting,
                        const RayBundle& bundle, FieldProgram& rest);

}  // namespace barkridge
