#pragma once
// The names of every node's kind and members, once, for everything that goes through them: text, checks.

#include <string_view>

#include "blobtree/tree.h"

namespace barkridge {

template <typename T>
inline constexpr std::string_view kNodeName = "";
template <>
inline constexpr std::string_view kNodeName<Cone> = "cone";
template <>
inline constexpr std::string_view kNodeName<FadedCone> = "faded_cone";
template <>
inline constexpr std::string_view kNodeName<Disc> = "disc";
template <>
inline constexpr std::string_view kNodeName<Ring> = "ring";
template <>
inline constexpr std::string_view kNodeName<Polygon> = "polygon";
template <>
inline constexpr std::string_view kNodeName<Sum> = "sum";
template <>
inline constexpr std::string_view kNodeName<Ricci> = "ricci";
template <>
inline constexpr std::string_view kNodeName<Union> = "union";
template <>
inline constexpr std::string_view kNodeName<Intersection> = "intersection";
template <>
inline constexpr std::string_view kNodeName<Difference> = "difference";
template <>
inline constexpr std::string_view kNodeName<Negative> = "negative";
template <>
inline constexpr std::string_view kNodeName<Contact> = "contact";
template <>
inline constexpr std::string_view kNodeName<Displacement> = "displacement";
template <>
inline constexpr std::string_view kNodeName<Bend> = "bend";
template <>
inline constexpr std::string_view kNodeName<Twist> = "twist";
template <>
inline constexpr std::string_view kNodeName<Taper> = "taper";
template <>
inline constexpr std::string_view kNodeName<Affine> = "affine";

/// Calls `field(name, member)` for every member, in the order of the text form. `T` may be const.
template <typename T, typename Field>
void for_each_field(T& node, Field field) {
  using Kind = std::remove_const_t<T>;
  if constexpr (std::is_same_v<Kind, Cone> || std::is_same_v<Kind, FadedCone>) {
    field("base", node.base);
    field("tip", node.tip);
    field("base_radius", node.base_radius);
    field("tip_radius", node.tip_radius);
    if constexpr (std::is_same_v<Kind, FadedCone>) {
      field("parent_radius", node.parent_radius);
      field("child_radius", node.child_radius);
    }
  } else if constexpr (std::is_same_v<Kind, Disc>) {
    field("center", node.center);
    field("normal", node.normal);
    field("disc_radius", node.disc_radius);
    field("radius", node.radius);
  } else if constexpr (std::is_same_v<Kind, Ring>) {
    field("center", node.center);
    field("normal", node.normal);
    field("ring_radius", node.ring_radius);
    field("radius", node.radius);
  } else if constexpr (std::is_same_v<Kind, Polygon>) {
    field("vertices", node.vertices);
    field("radius", node.radius);
  } else if constexpr (std::is_same_v<Kind, Ricci>) {
    field("exponent", node.exponent);
  } else if constexpr (std::is_same_v<Kind, Contact>) {
    field("width", node.shape.width);
    field("swelling", node.shape.swelling);
    field("allow_large_swelling", node.shape.allow_large_swelling);
  } else if constexpr (std::is_same_v<Kind, Displacement>) {
    field("amount", node.amount);
    field("wavelength", node.noise.wavelength);
    field("stretch", node.noise.stretch);
    field("octaves", node.noise.octaves);
    field("ridged", node.noise.ridged);
    field("seed", node.noise.seed);
  } else if constexpr (std::is_same_v<Kind, Bend>) {
    field("base", node.base);
    field("tip", node.tip);
    field("direction", node.direction);
    field("angle_degrees", node.angle_degrees);
  } else if constexpr (std::is_same_v<Kind, Twist>) {
    field("origin", node.origin);
    field("axis", node.axis);
    field("degrees_per_unit", node.degrees_per_unit);
  } else if constexpr (std::is_same_v<Kind, Taper>) {
    field("base", node.base);
    field("tip", node.tip);
    field("tip_scale", node.tip_scale);
  } else if constexpr (std::is_same_v<Kind, Affine>) {
    field("linear", node.linear);
    field("offset", node.offset);
  }
}

}  // namespace barkridge
