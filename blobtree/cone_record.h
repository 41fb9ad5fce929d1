#pragma once
// A cone as the compiled field stores it: one cache line, whatever its ends are like.

#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "blobtree/field.h"
#include "blobtree/tree.h"

namespace barkridge {

/// How a model's numbers are made fit for single precision.
struct ModelUnits {
  /// Lengths in units of the model are lengths in scene units times this.
  double scale = 1;
  /// Points are evaluated relative to the nearest of a grid of origins with this spacing, in units of the model. So
  /// their places are good to 2^-24 of it.
  double origin_spacing = 1.0 / 16;
};

/// How a record is to be evaluated.
enum class ConeKind : std::uint8_t {
  kPlain,    ///< a cone with two round caps
  kFaded,    ///< a faded cone
  kSteady,   ///< any, where no cap, fade or limit is at work; bounds on a region find out where that is
  kLimited,  ///< a faded cone in whose support a limit of the radius may be at work
};

/// Lengths but for the base are in units of the model: scene units times a scale that all its records share.
struct alignas(64) ConeRecord {
  Vec3 base{0};  ///< in scene units
  glm::vec3 axis{0, 1, 0};
  float base_radius = 1;
  float taper = 0;  ///< growth of the radius per length
  float length = 0;
  /// The fades of a faded cone, S((y - start) * scale) [docs/field.md, "Faded joints"]; infinite where the end is free.
  float rise_start = 0, rise_scale = 1;
  float fall_start = 0, fall_scale = 1;

  float tip_radius() const { return base_radius + taper * length; }
  bool has_free_base() const { return rise_start == -std::numeric_limits<float>::infinity(); }
  bool has_free_tip() const { return fall_start == std::numeric_limits<float>::infinity(); }
};
static_assert(sizeof(ConeRecord) == 64);

ConeRecord record_of(const Cone& cone, double scale);
ConeRecord record_of(const FadedCone& cone, double scale);

/// kFaded or kLimited.
ConeKind kind_of_faded(const ConeRecord& cone);
/// Of a cone whose radius may be limited: a bound of the slope of the normalised distance in its support.
double limited_slope(const ConeRecord& cone);

struct ConeBounds {
  FieldBounds field;    ///< of values, and of gradients in scene units
  bool steady = false;  ///< whether evaluation as kSteady gives the same bits as the record's kind, all over the region
};

/// Conservative for what evaluation in single precision makes of the formulas, and exact to first order in the box's
/// size. [docs/field.md, "Bounds"]
ConeBounds bounds_of(const ConeRecord& cone, ConeKind kind, const ModelUnits& units, const Box& box);

/// The places beside which a cone's field can be other than zero, and the largest distance from its axis; in units of
/// the model.
struct ConeSupport {
  Interval along;
  double lateral;
};
ConeSupport support_of(const ConeRecord& cone, ConeKind kind);

}  // namespace barkridge
