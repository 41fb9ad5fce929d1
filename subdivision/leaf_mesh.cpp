#include "subdivision/leaf_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>

#include "base/error.h"
#include "base/large_room.h"
#include "subdivision/branches.h"
#include "subdivision/frames.h"

namespace barkridge {

namespace {

using Vec2 = glm::dvec2;

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

void check_options(const LeafOptions& options) {
  const auto check = [](bool good, const char* name, double value, const char* expected) {
    if (!good) throw InputError(fmt::format("{} is {}: expected {}", name, value, expected));
  };
  check(options.fold_degrees >= 0 && options.fold_degrees < 90, "fold_degrees", options.fold_degrees,
        "0 to less than 90");
  check(options.midrib_sharpness >= 0, "midrib_sharpness", options.midrib_sharpness, "0 or more");
  check(options.point_length >= 0 && std::isfinite(options.point_length), "point_length", options.point_length,
        "a finite number, 0 or more");
}

// The frame's normal is the upper side. A place in the flat leaf is turned by `heading` from +v, against the clock.
struct Flat {
  Vec2 position{0};
  double heading = 0;

  Vec2 forward() const { return {-std::sin(heading), std::cos(heading)}; }
  Vec2 left() const { return {-std::cos(heading), -std::sin(heading)}; }
};

// A cross-section: left margin, midrib, right margin.
struct LeafRow {
  Frame frame;
  double half_width = 0;
  Flat flat;
  double v = 0;  // along the lobes
  InternodeId internode = 0;
  std::array<std::uint32_t, 3> vertices{};
  std::array<std::uint32_t, 3> texture{};
};

Vec3 left_of(const Frame& frame) { return -frame.binormal(); }

// The angle by which the leaf turns to its left in its plane from one direction to the next.
double turn(const Frame& frame, const Vec3& tangent) {
  const double left = glm::dot(tangent, left_of(frame));
  const double ahead = std::sqrt(std::max(0.0, 1 - left * left));
  return std::atan2(left, glm::dot(tangent, frame.tangent) < 0 ? -ahead : ahead);
}

Flat moved(const Flat& from, double turned, double distance) {
  // A turn between two cross-sections lies halfway between them.
  const Flat halfway{from.position, from.heading + 0.5 * turned};
  return {from.position + distance * halfway.forward(), from.heading + turned};
}

class LeafDresser {
 public:
  LeafDresser(const Skeleton& skeleton, Branches& branches, const std::vector<Cut>& cuts, const LeafOptions& options)
      : skeleton_(skeleton), branches_(branches), cuts_(cuts), options_(options), starts_(branches.branches.size()) {
    const std::size_t rows = branches.nodes.size() + 2 * branches.branches.size();
    constexpr std::size_t kMostRows = 400'000'000;
    if (rows > kMostRows) {
      throw LimitError(fmt::format("the leaf may need {} cross-sections, more than {}", rows, kMostRows));
    }
    reserve_large(mesh_.positions, 3 * rows);
    reserve_large(mesh_.triangles, 4 * rows);
    reserve_large(mesh_.texture_triangles, 4 * rows);
  }

  ControlMesh dress() {
    for (std::uint32_t b = 0; b < branches_.branches.size(); ++b) {
      const Branch& branch = branches_.branches[b];
      if (branch.parent < 0) start_leaf(b);
      const LeafRow end = walk(b);
      if (branch.child_count > 0) {
        build_joint(b, end);
      } else {
        add_point(end, branches_.axis(branch).back().position);
      }
    }
    if (options_.texture == LeafTexture::kWhole) fit_texture();
    mesh_.ages = ages_of(mesh_.internodes, skeleton_);
    return std::move(mesh_);
  }

 private:
  std::uint32_t add_vertex(const Vec3& position, InternodeId internode) {
    mesh_.positions.emplace_back(position);
    mesh_.internodes.push_back(internode);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  // One of the row's three texture coordinates: -1 at the left margin, 0 at the midrib, 1 at the right one.
  std::uint32_t add_texture(const LeafRow& row, int side) {
    if (options_.texture == LeafTexture::kLobes) {
      mesh_.texture.emplace_back(0.5 + 0.5 * side, row.v);
    } else {
      mesh_.texture.emplace_back(row.flat.position - side * row.half_width * row.flat.left());
    }
    return static_cast<std::uint32_t>(mesh_.texture.size() - 1);
  }

  // `right` is the neighbour on that side, if its margin is to be shared.
  LeafRow add_row(const AxisPoint& at, const Frame& frame, const Flat& flat, double v, const LeafRow* right = nullptr) {
    LeafRow row{frame, at.radius, flat, v, at.internode, {}, {}};
    const double fold = options_.fold_degrees * kRadiansPerDegree;
    const auto margin = [&](double side) {
      return at.position + at.radius * (side * std::cos(fold) * left_of(frame) + std::sin(fold) * frame.normal);
    };
    row.vertices[0] = add_vertex(margin(1), at.internode);
    row.vertices[1] = add_vertex(at.position, at.internode);
    for (int i = 0; i < 2; ++i) row.texture[static_cast<std::size_t>(i)] = add_texture(row, i - 1);
    if (right == nullptr) {
      row.vertices[2] = add_vertex(margin(-1), at.internode);
      row.texture[2] = add_texture(row, 1);
    } else {
      merge_margin(row, margin(-1), *right);
    }
    return row;
  }

  // The row's right margin and its neighbour's left one become one vertex halfway between both.
  void merge_margin(LeafRow& row, const Vec3& margin, const LeafRow& right) {
    row.vertices[2] = right.vertices[0];
    glm::vec3& position = mesh_.positions[row.vertices[2]];
    position = glm::vec3(0.5 * (Vec3(position) + margin));
    row.texture[2] = add_texture(row, 1);
    if (options_.texture == LeafTexture::kLobes) return;
    glm::vec2& shared = mesh_.texture[right.texture[0]];
    shared = 0.5F * (shared + mesh_.texture.back());
    mesh_.texture.pop_back();
    row.texture[2] = right.texture[0];
  }

  void add_triangle(const std::array<std::uint32_t, 3>& vertices, const std::array<std::uint32_t, 3>& texture) {
    mesh_.triangles.push_back(vertices);
    mesh_.texture_triangles.push_back(texture);
  }

  void add_midrib(std::uint32_t from, std::uint32_t to) {
    if (options_.midrib_sharpness > 0) mesh_.sharp_edges.push_back({{from, to}, options_.midrib_sharpness});
  }

  // The blade between two cross-sections: two quadrangles that mirror each other.
  void add_blade(const LeafRow& lower, const LeafRow& upper) {
    const auto &v = lower.vertices, &w = upper.vertices, &s = lower.texture, &t = upper.texture;
    add_triangle({v[0], v[1], w[1]}, {s[0], s[1], t[1]});
    add_triangle({v[0], w[1], w[0]}, {s[0], t[1], t[0]});
    add_triangle({v[1], v[2], w[1]}, {s[1], s[2], t[1]});
    add_triangle({v[2], w[2], w[1]}, {s[2], t[2], t[1]});
    add_midrib(v[1], w[1]);
  }

  void add_point(const LeafRow& row, const Vec3& tip) {
    if (options_.point_length == 0) return;
    const double length = options_.point_length * row.half_width;
    LeafRow point = row;
    point.flat = moved(row.flat, 0, length);
    point.v += 1;
    const std::uint32_t vertex = add_vertex(tip + length * row.frame.tangent, row.internode);
    const std::uint32_t texture = add_texture(point, 0);
    add_triangle({row.vertices[0], row.vertices[1], vertex}, {row.texture[0], row.texture[1], texture});
    add_triangle({row.vertices[1], row.vertices[2], vertex}, {row.texture[1], row.texture[2], texture});
    add_midrib(row.vertices[1], vertex);
    if (options_.sharp_point) mesh_.sharp_vertices.push_back({vertex});
  }

  // The side of a joint's plane that is nearer to the given one.
  static Vec3 facing(const Vec3& normal, const Vec3& side) { return glm::dot(normal, side) < 0 ? -normal : normal; }

  void start_leaf(std::uint32_t b) {
    const AxisPoint at = point_on(branches_.axis(branches_.branches[b]), 0);
    const bool joint = branches_.branches[b].child_count > 0;
    const Vec3 up = joint ? facing(cuts_[b].normal, options_.up) : options_.up;
    starts_[b] = add_row(at, frame_towards(at.tangent, up), {}, 0);
  }

  // From a branch's first row to the one at its joint or tip.
  LeafRow walk(std::uint32_t b) {
    const Branch& branch = branches_.branches[b];
    const auto axis = branches_.axis(branch);
    const Cut& cut = cuts_[b];
    const bool joint = branch.child_count > 0;
    const double length = axis.back().along, end = length - cut.tip;
    const double start_v = starts_[b].v - cut.base / length;
    double along = cut.base;
    LeafRow row = starts_[b];
    const auto reach = [&](const AxisPoint& at, double place) {
      Frame frame = transported(row.frame, at.tangent);
      if (joint && place == end) frame = frame_towards(at.tangent, facing(cut.normal, frame.normal));
      const Flat flat = moved(row.flat, turn(row.frame, at.tangent), place - along);
      const LeafRow next = add_row(at, frame, flat, start_v + (place == end ? 1 : place / length));
      add_blade(row, next);
      row = next;
      along = place;
    };
    const double from = along + (branch.parent >= 0 ? options_.joint.gap * axis.front().radius : 0);
    const double to = end - (joint ? options_.joint.gap * axis.back().radius : 0);
    for (std::size_t i = 1; i + 1 < axis.size(); ++i) {
      const BranchNode& node = axis[i];
      if (!(node.along > from && node.along < to)) continue;
      reach({node.position, tangent_at(axis, i), node.radius, node.internode}, node.along);
    }
    reach(point_on(axis, end), end);
    return row;
  }

  // A fan around the end of the carrying midrib, along all that bounds the joint.
  void build_joint(std::uint32_t b, const LeafRow& end) {
    const auto children = branches_.children_of(branches_.branches[b]);
    if (glm::dot(cuts_[b].normal, end.frame.normal) < 0) std::reverse(children.begin(), children.end());
    const Flat joint = moved(end.flat, 0, cuts_[b].tip);
    const auto fan = [&](std::uint32_t v, std::uint32_t w, std::uint32_t s, std::uint32_t t) {
      add_triangle({end.vertices[1], v, w}, {end.texture[1], s, t});
    };
    const LeafRow* right = nullptr;
    for (const std::uint32_t child : children) {
      const auto axis = branches_.axis(branches_.branches[child]);
      const double base = cuts_[child].base;
      const AxisPoint at = point_on(axis, base);
      const Flat leaving{joint.position, joint.heading + turn(end.frame, at.tangent)};
      LeafRow& row = starts_[child];
      row = add_row(at, transported(end.frame, at.tangent), moved(leaving, 0, base), end.v + base / axis.back().along,
                    right);
      if (right == nullptr) fan(end.vertices[2], row.vertices[2], end.texture[2], row.texture[2]);
      fan(row.vertices[2], row.vertices[1], row.texture[2], row.texture[1]);
      fan(row.vertices[1], row.vertices[0], row.texture[1], row.texture[0]);
      add_midrib(end.vertices[1], row.vertices[1]);
      right = &row;
    }
    fan(right->vertices[0], end.vertices[0], right->texture[0], end.texture[0]);
  }

  void fit_texture() {
    if (mesh_.texture.empty()) return;
    glm::vec2 lo = mesh_.texture.front(), hi = lo;
    for (const glm::vec2& place : mesh_.texture) {
      lo = glm::min(lo, place);
      hi = glm::max(hi, place);
    }
    const float size = std::max(hi.x - lo.x, hi.y - lo.y);
    for (glm::vec2& place : mesh_.texture) place = (place - lo) / size;
  }

  const Skeleton& skeleton_;
  Branches& branches_;
  const std::vector<Cut>& cuts_;
  const LeafOptions& options_;
  std::vector<LeafRow> starts_;  // of every branch
  ControlMesh mesh_;
};

}  // namespace

ControlMesh leaf_mesh(const Skeleton& skeleton, const LeafOptions& options) {
  check_options(options);
  JointOptions joint = options.joint;
  joint.thin_ratio = 0;
  Branches branches = branches_of(skeleton, BranchEnd::kAtJoints);
  const std::vector<Cut> cuts = plan_joints(branches, joint, std::cos(options.fold_degrees * kRadiansPerDegree));
  return LeafDresser(skeleton, branches, cuts, options).dress();
}

}  // namespace barkridge
