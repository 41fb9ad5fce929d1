#include "bark/branch_coordinates.h"

#include <cmath>
#include <numbers>
#include <type_traits>

namespace barkridge {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// The least rotation that brings one unit vector to another, of a vector; some rotation where they are opposite.
Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 cross = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  if (cosine < -0.999999) {
    Vec3 t, b;
    complete_frame(from, t, b);
    return 2 * glm::dot(v, t) * t - v;
  }
  return v * cosine + glm::cross(cross, v) + cross * (glm::dot(cross, v) / (1 + cosine));
}

Mat3 frame_from(const Vec3& axis, const Vec3& across) {
  const Vec3 x = glm::normalize(across - glm::dot(across, axis) * axis);
  return {x, axis, glm::cross(x, axis)};
}

Mat3 any_frame(const Vec3& axis) {
  Vec3 t, b;
  complete_frame(axis, t, b);
  return frame_from(axis, t);
}

// The piece of an axis of linear radius up to a height, each length over the circumference.
double turns_up_to(const BranchFrame& frame, double y) {
  const double r0 = frame.base_radius, r1 = frame.tip_radius;
  if (y <= 0 || !(frame.length > 0)) return y / (kTurn * r0);
  if (y > frame.length) return turns_up_to(frame, frame.length) + (y - frame.length) / (kTurn * r1);
  const double slope = (r1 - r0) / frame.length, growth = slope * y / r0;
  // log1p(x) / x, which is 1 where the radius does not change.
  return y / (kTurn * r0) * (std::abs(growth) < 1e-9 ? 1 : std::log1p(growth) / growth);
}

// Which way a bent axis runs at its ends, where its straight primitive's runs along `axis`.
struct Tangents {
  Vec3 start, end;
};
Tangents tangents(const Vec3& axis, const Bend* bend) {
  if (!bend) return {axis, axis};
  const Vec3 side = glm::normalize(bend->direction - glm::dot(bend->direction, axis) * axis);
  const double half = bend->angle_degrees * kTurn / 720;
  return {std::cos(half) * axis + std::sin(half) * side, std::cos(half) * axis - std::sin(half) * side};
}

// ---- A primitive by itself.

template <typename RoundCone>
BranchFrame cone_frame(const RoundCone& cone) {
  BranchFrame frame;
  frame.base = cone.base;
  frame.length = glm::distance(cone.base, cone.tip);
  frame.axes = any_frame(frame.length > 0 ? (cone.tip - cone.base) / frame.length : Vec3(0, 1, 0));
  frame.base_radius = cone.base_radius;
  frame.tip_radius = cone.tip_radius;
  if (frame.length == 0) frame.base_radius = frame.tip_radius = std::max(cone.base_radius, cone.tip_radius);
  return frame;
}
BranchFrame frame_of(const Cone& cone) { return cone_frame(cone); }
BranchFrame frame_of(const FadedCone& cone) { return cone_frame(cone); }

BranchFrame flat_frame(const Vec3& center, const Vec3& normal, double radius) {
  BranchFrame frame;
  frame.base = center;
  frame.axes = any_frame(normal);
  frame.base_radius = frame.tip_radius = radius;
  return frame;
}
BranchFrame frame_of(const Disc& disc) {
  return flat_frame(disc.center, glm::normalize(disc.normal), disc.disc_radius + disc.radius);
}
BranchFrame frame_of(const Ring& ring) {
  return flat_frame(ring.center, glm::normalize(ring.normal), ring.ring_radius + ring.radius);
}
BranchFrame frame_of(const Polygon& polygon) {
  const Vec3& a = polygon.vertices[0];
  const Vec3 cross = glm::cross(polygon.vertices[1] - a, polygon.vertices[2] - a);
  const double length = glm::length(cross);
  return flat_frame(a, length > 0 ? cross / length : Vec3(0, 1, 0), polygon.radius);
}

// Puts a frame at the end of its parent's.
void continue_branch(const BranchFrame& parent, const Bend* parent_bend, const Bend* bend, BranchFrame& frame) {
  frame.along = parent.along + parent.length;
  frame.turns = parent.turns + turns_up_to(parent, parent.length);
  const Vec3 &from_axis = parent.axes[1], &axis = frame.axes[1];
  const Vec3 end = tangents(from_axis, parent_bend).end, start = tangents(axis, bend).start;
  frame.axes = frame_from(axis, turned(turned(turned(parent.axes[0], from_axis, end), end, start), start, axis));
}

}  // namespace

BranchPoint branch_point(const BranchFrame& frame, const Vec3& point) {
  const Vec3 local = glm::transpose(frame.axes) * (point - frame.base);
  const double y = std::clamp(local.y, 0.0, frame.length);
  const double share = frame.length > 0 ? y / frame.length : 0.0;
  BranchPoint result;
  result.position = {local.x, frame.along + local.y, local.z};
  result.around = std::atan2(local.x, local.z);
  result.turns = frame.turns + turns_up_to(frame, local.y);
  result.radius = frame.base_radius + share * (frame.tip_radius - frame.base_radius);
  return result;
}

BranchCoordinates::BranchCoordinates(const BlobTree& tree, const Skeleton& skeleton,
                                     std::span<const NodeId> primitives) {
  std::vector<const Bend*> bends;  // by frame
  std::vector<const Bend*> bend_above(tree.nodes.size());
  places_.resize(tree.nodes.size());
  for (const Node& node : tree.nodes) {
    if (const Bend* bend = std::get_if<Bend>(&node.what)) bend_above[node.children[0]] = bend;
  }
  for (NodeId id = 0; id < tree.nodes.size(); ++id) {
    std::visit(
        [&](const auto& what) {
          if constexpr (requires { frame_of(what); }) {
            places_[id] = static_cast<std::uint32_t>(frames_.size());
            frames_.push_back(frame_of(what));
            bends.push_back(bend_above[id]);
            thickest_ = std::max({thickest_, frames_.back().base_radius, frames_.back().tip_radius});
          }
        },
        tree.nodes[id].what);
  }
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    if (primitives[i] == kNoNode) continue;
    const std::uint32_t place = places_[primitives[i]];
    const Internode& internode = skeleton.internodes[i];
    BranchFrame& frame = frames_[place];
    // A primitive may be shorter than its internode.
    frame.internode = static_cast<InternodeId>(i);
    frame.base = internode.base;
    frame.length = bends[place] ? arc_length(*bends[place]) : glm::distance(internode.base, internode.tip);
    frame.axes = any_frame(glm::normalize(internode.tip - internode.base));
    frame.base_radius = internode.base_radius;
    frame.tip_radius = internode.tip_radius;
    const InternodeId parent = internode.parent;
    if (parent == kNoInternode) continue;
    const std::uint32_t from = places_[primitives[static_cast<std::size_t>(parent)]];
    continue_branch(frames_[from], bends[from], bends[place], frame);
  }
}

}  // namespace barkridge
