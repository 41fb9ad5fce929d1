#include "subdivision/hull.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/large_room.h"
#include "subdivision/hull_graph.h"
#include "subdivision/hull_joint.h"

namespace barkridge {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// A tip so much thinner than its base is a point.
constexpr double kPointedRatio = 1e-3;

// An orthonormal frame across a branch: `growth = side x forward`.
struct Frame {
  Vec3 growth{0, 1, 0};
  Vec3 side{1, 0, 0};
  Vec3 forward{0, 0, -1};
};

// The frame after the least rotation that brings its growth to a direction: no twist along a branch.
Frame turned(const Frame& frame, const Vec3& growth) {
  const double cosine = glm::dot(frame.growth, growth);
  Vec3 side = frame.side;
  if (cosine > -0.999999) side -= glm::dot(side, growth) / (1 + cosine) * (frame.growth + growth);
  side = glm::normalize(side - glm::dot(side, growth) * growth);
  return {growth, side, glm::cross(growth, side)};
}

// What a branch becomes: rings at even distances from `start` to `end` along it, and where they are in the mesh.
struct Tube {
  Frame frame;
  double length = 0;
  double start = 0, end = 0;
  double start_radius = 0, end_radius = 0;  // before joints' cones narrow it
  double start_slope = 0, end_slope = 0;    // tangents of the cones' angles; infinite without
  int segments = 0;
  bool pointed = false;  // the last ring is one vertex
  bool base_cap = false, tip_cap = false;
  double v = 0, v_per_length = 0;         // texture along the branch from its base point on
  std::uint32_t first_row = 0, rows = 0;  // vertices of the first ring, which may be the parent's; of the second
  std::uint32_t first_texture = 0, texture = 0;
  std::uint32_t base_apex = 0, tip_apex = 0;  // vertices
  std::uint32_t base_apex_texture = 0, tip_apex_texture = 0;
  std::size_t first_triangle = 0;
};

struct Joint {
  std::uint32_t node = 0;
  std::vector<std::uint32_t> branches;  // the one that ends here, if any, then those that begin
  HullJoint hull;
  std::uint32_t first_extra = 0;    // vertex
  std::uint32_t first_texture = 0;  // room for three a triangle
  std::size_t first_triangle = 0;
};

class Surface {
 public:
  Surface(const Skeleton& skeleton, const HullOptions& options)
      : skeleton_(skeleton),
        options_(options),
        count_(static_cast<std::uint32_t>(options.ring_vertices)),
        finest_(finest_length(skeleton)),
        graph_(hull_graph(skeleton, options.thinnest_ring)) {}

  ControlMesh build() {
    set_tubes();
    set_joints();
    number();
    tbb::parallel_for(std::size_t{0}, graph_.branches(), [&](std::size_t i) {
      if (!graph_.gone[i]) write_tube(i);
    });
    tbb::parallel_for(std::size_t{0}, joints_.size(), [&](std::size_t i) { write_joint(joints_[i]); });
    set_sharpness();
    return std::move(mesh_);
  }

 private:
  const HullTrim& base_trim(std::size_t i) const { return graph_.base_trims[i]; }
  const HullTrim& tip_trim(std::size_t i) const { return graph_.tip_trims[i]; }
  bool bends_at_base(std::size_t i) const { return base_trim(i).end == HullEnd::kBend; }

  // ---- Planning.

  // The radius at a branch's base or tip point; a bend's is the mean of its two branches'.
  double radius_at(std::size_t node, std::size_t branch) const {
    if (node != branch) {
      return bends_at_base(branch) ? radius_at(node, node) : graph_.base_radii[branch];
    }
    if (tip_trim(branch).end != HullEnd::kBend) return graph_.tip_radii[branch];
    const std::uint32_t next = graph_.children[graph_.first[node]];
    const double mean = (graph_.tip_radii[branch] + graph_.base_radii[next]) / 2;
    // Rings keep to the cones of joints at the other ends of both branches.
    const double below = width(slope(base_trim(branch)), length(branch)),
                 above = width(slope(tip_trim(next)), length(next));
    return std::max(std::min({mean, below, above}), finest_);
  }

  static double slope(const HullTrim& trim) {
    return trim.end == HullEnd::kJoint ? std::tan(trim.angle) : std::numeric_limits<double>::infinity();
  }
  // A cone's radius at a distance from its apex; no limit where there is no cone.
  static double width(double slope, double distance) { return std::isfinite(slope) ? slope * distance : slope; }
  double length(std::size_t branch) const {
    return glm::distance(graph_.positions[branch], graph_.positions[graph_.up[branch]]);
  }

  void set_tubes() {
    tubes_.resize(graph_.branches());
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (graph_.gone[i]) continue;
      Tube& tube = tubes_[i];
      const std::uint32_t up = graph_.up[i];
      tube.length = length(i);
      tube.start_slope = slope(base_trim(i));
      tube.end_slope = slope(tip_trim(i));
      const double scale = ring_scale(graph_, i);
      if (base_trim(i).end == HullEnd::kJoint) tube.start = scale * base_trim(i).offset;
      tube.end = tube.length;
      if (tip_trim(i).end == HullEnd::kJoint) tube.end -= scale * tip_trim(i).offset;
      tube.start_radius = radius_at(up, i);
      tube.end_radius = radius_at(i, i);
      tube.base_cap = base_trim(i).end == HullEnd::kFree;
      tube.pointed =
          tip_trim(i).end == HullEnd::kFree && tube.end_radius <= std::max(finest_, kPointedRatio * tube.start_radius);
      tube.tip_cap = tip_trim(i).end == HullEnd::kFree && !tube.pointed;
      const double radius = (tube.start_radius + tube.end_radius) / 2;
      // [Pie12, section 4.3.2]: two segments are about as long as the branch is around.
      const double segments = std::round((tube.end - tube.start) / (std::numbers::pi * radius));
      tube.segments = static_cast<int>(std::clamp(segments, 1.0, double(options_.max_segments)));
      tube.v_per_length = 1 / (kTurn * radius);
      const Vec3 growth = (graph_.positions[i] - graph_.positions[up]) / tube.length;
      const Tube* const parent = graph_.is_base(up) ? nullptr : &tubes_[up];
      tube.frame = turned(parent ? parent->frame : Frame{}, growth);
      if (parent) tube.v = parent->v + parent->length * parent->v_per_length;
    }
  }

  HullRing ring_at(std::uint32_t node, std::uint32_t branch) const {
    const HullTrim& trim = node == branch ? tip_trim(branch) : base_trim(branch);
    const Tube& tube = tubes_[branch];
    const Frame& frame = tube.frame;
    return {node == branch ? -frame.growth : frame.growth,       frame.side, frame.forward, trim.angle, trim.gap,
            node == branch ? tube.length - tube.end : tube.start};
  }

  void set_joints() {
    for (std::uint32_t node = 0; node < graph_.positions.size(); ++node) {
      const std::uint32_t first = graph_.first[node], last = graph_.first[node + 1];
      if (first == last || base_trim(graph_.children[first]).end != HullEnd::kJoint) continue;
      Joint joint;
      joint.node = node;
      if (!graph_.is_base(node)) joint.branches.push_back(node);
      joint.branches.insert(joint.branches.end(), graph_.children.begin() + first, graph_.children.begin() + last);
      joints_.push_back(std::move(joint));
    }
    tbb::parallel_for(std::size_t{0}, joints_.size(), [&](std::size_t i) {
      std::vector<HullRing> rings;
      for (const std::uint32_t branch : joints_[i].branches) rings.push_back(ring_at(joints_[i].node, branch));
      joints_[i].hull = hull_joint(rings, options_.ring_vertices);
    });
  }

  // ---- Numbering.

  void number() {
    std::uint64_t vertices = 0, texture = 0, triangles = 0;
    const auto take = [](std::uint64_t& total, std::uint64_t count) {
      total += count;
      return static_cast<std::uint32_t>(total - count);
    };
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (graph_.gone[i]) continue;
      Tube& tube = tubes_[i];
      if (bends_at_base(i)) {
        const Tube& parent = tubes_[graph_.up[i]];
        tube.first_row = row(parent, parent.segments);
        tube.first_texture = texture_row(parent, parent.segments);
      } else {
        tube.first_row = take(vertices, count_);
        tube.first_texture = take(texture, count_ + 1);
      }
      const auto rings = static_cast<std::uint64_t>(tube.segments) - (tube.pointed ? 1 : 0);
      tube.rows = take(vertices, rings * count_ + (tube.pointed ? 1 : 0));
      tube.texture = take(texture, rings * (count_ + 1) + (tube.pointed ? count_ : 0));
      if (tube.base_cap) {
        tube.base_apex = take(vertices, 1);
        tube.base_apex_texture = take(texture, count_);
      }
      if (tube.tip_cap) {
        tube.tip_apex = take(vertices, 1);
        tube.tip_apex_texture = take(texture, count_);
      }
      tube.first_triangle = triangles;
      triangles += count_ * (2 * static_cast<std::uint64_t>(tube.segments) - (tube.pointed ? 1 : 0) +
                             (tube.base_cap ? 1 : 0) + (tube.tip_cap ? 1 : 0));
    }
    for (Joint& joint : joints_) {
      joint.first_extra = take(vertices, joint.hull.extra.size());
      joint.first_texture = take(texture, 3 * joint.hull.triangles.size());
      joint.first_triangle = triangles;
      triangles += joint.hull.triangles.size();
    }
    const std::uint64_t most = std::min<std::uint64_t>(options_.max_triangles, 0xffffffffu / 3);
    if (triangles > most) {
      throw LimitError(
          fmt::format("the control mesh would have {} triangles; at most {} are allowed", triangles, most));
    }
    resize_large(mesh_.positions, vertices);
    resize_large(mesh_.internodes, vertices);
    resize_large(mesh_.ages, vertices);
    resize_large(mesh_.triangles, triangles);
    resize_large(mesh_.texture, texture);
    resize_large(mesh_.texture_triangles, triangles);
    for (const Internode& internode : skeleton_.internodes) youngest_ = std::max(youngest_, internode.birth_step);
  }

  // The first vertex, or texture coordinate, of a tube's ring; of rings' texture there is one more than of vertices.
  std::uint32_t row(const Tube& tube, int i) const {
    return i == 0 ? tube.first_row : tube.rows + static_cast<std::uint32_t>(i - 1) * count_;
  }
  std::uint32_t texture_row(const Tube& tube, int i) const {
    return i == 0 ? tube.first_texture : tube.texture + static_cast<std::uint32_t>(i - 1) * (count_ + 1);
  }

  // ---- Writing. Every tube and joint has its own part of the mesh.

  void set_vertex(std::uint32_t vertex, const Vec3& position, std::size_t branch) {
    mesh_.positions[vertex] = glm::vec3(position);
    mesh_.internodes[vertex] = static_cast<InternodeId>(branch);
    mesh_.ages[vertex] = static_cast<float>(youngest_ - skeleton_.internodes[branch].birth_step);
  }

  static double radius_along(const Tube& tube, double t) {
    const double part = (t - tube.start) / (tube.end - tube.start);
    const double radius = tube.start_radius + part * (tube.end_radius - tube.start_radius);
    return std::min({radius, width(tube.start_slope, t), width(tube.end_slope, tube.length - t)});
  }

  void write_ring(std::size_t branch, int i) {
    const Tube& tube = tubes_[branch];
    const double t = tube.start + (tube.end - tube.start) * i / tube.segments;
    Frame frame = tube.frame;
    double radius = radius_along(tube, t);
    // Rings at joints lie on the joint's cone exactly, whatever the other end's is.
    if (i == 0 && std::isfinite(tube.start_slope)) radius = tube.start_slope * t;
    if (i == tube.segments && std::isfinite(tube.end_slope)) radius = tube.end_slope * (tube.length - t);
    if (i == tube.segments && tip_trim(branch).end == HullEnd::kBend) {
      radius = tube.end_radius;
      const Vec3& next = tubes_[graph_.children[graph_.first[branch]]].frame.growth;
      frame = turned(frame, glm::normalize(frame.growth + next));
    }
    const Vec3 center = graph_.positions[graph_.up[branch]] + t * tube.frame.growth;
    const HullRing flat{frame.growth, frame.side, frame.forward, std::numbers::pi / 2};
    for (std::uint32_t j = 0; j < count_; ++j) {
      set_vertex(row(tube, i) + j, center + radius * ring_direction(flat, static_cast<int>(j), options_.ring_vertices),
                 branch);
    }
    const double v = tube.v + t * tube.v_per_length;
    for (std::uint32_t j = 0; j <= count_; ++j) {
      mesh_.texture[texture_row(tube, i) + j] = glm::vec2(static_cast<double>(j) / count_, v);
    }
  }

  // An end's middle, or a tip's point, and its texture: one for each triangle around it.
  void write_apex(std::size_t branch, double t, double v, std::uint32_t vertex, std::uint32_t texture) {
    set_vertex(vertex, graph_.positions[graph_.up[branch]] + t * tubes_[branch].frame.growth, branch);
    for (std::uint32_t j = 0; j < count_; ++j) mesh_.texture[texture + j] = glm::vec2((j + 0.5) / count_, v);
  }

  void write_tube(std::size_t branch) {
    const Tube& tube = tubes_[branch];
    for (int i = bends_at_base(branch) ? 1 : 0; i < tube.segments + (tube.pointed ? 0 : 1); ++i) write_ring(branch, i);
    const double v = tube.v, tip_v = tube.v + tube.length * tube.v_per_length;
    if (tube.base_cap) write_apex(branch, 0, v - 1 / kTurn, tube.base_apex, tube.base_apex_texture);
    if (tube.tip_cap) write_apex(branch, tube.length, tip_v + 1 / kTurn, tube.tip_apex, tube.tip_apex_texture);
    const std::uint32_t point = row(tube, tube.segments), point_texture = texture_row(tube, tube.segments);
    if (tube.pointed) write_apex(branch, tube.length, tip_v, point, point_texture);

    std::size_t next = tube.first_triangle;
    using Corner = std::array<std::uint32_t, 2>;  // vertex and texture
    const auto corner = [&](int i, std::uint32_t j) -> Corner {
      return {row(tube, i) + j % count_, texture_row(tube, i) + j};
    };
    const auto put = [&](Corner a, Corner b, Corner c) {
      mesh_.triangles[next] = {a[0], b[0], c[0]};
      mesh_.texture_triangles[next++] = {a[1], b[1], c[1]};
    };
    for (std::uint32_t j = 0; j < count_; ++j) {
      if (tube.base_cap) put(corner(0, j + 1), corner(0, j), {tube.base_apex, tube.base_apex_texture + j});
      for (int i = 0; i < tube.segments; ++i) {
        if (tube.pointed && i == tube.segments - 1) {
          put(corner(i, j), corner(i, j + 1), {point, point_texture + j});
        } else {
          put(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1));
          put(corner(i, j), corner(i + 1, j + 1), corner(i + 1, j));
        }
      }
      if (tube.tip_cap) {
        put(corner(tube.segments, j), corner(tube.segments, j + 1), {tube.tip_apex, tube.tip_apex_texture + j});
      }
    }
  }

  std::uint32_t row_at(std::uint32_t node, std::uint32_t branch) const {
    return row(tubes_[branch], node == branch ? tubes_[branch].segments : 0);
  }
  std::uint32_t texture_row_at(std::uint32_t node, std::uint32_t branch) const {
    return texture_row(tubes_[branch], node == branch ? tubes_[branch].segments : 0);
  }
  double joint_radius(std::uint32_t node, std::uint32_t branch) const {
    return node == branch ? graph_.tip_radii[branch] : graph_.base_radii[branch];
  }

  std::uint32_t thickest(const Joint& joint) const {
    return *std::max_element(joint.branches.begin(), joint.branches.end(), [&](std::uint32_t a, std::uint32_t b) {
      return joint_radius(joint.node, a) < joint_radius(joint.node, b);
    });
  }

  void write_extra_vertices(const Joint& joint) {
    for (std::size_t i = 0; i < joint.hull.extra.size(); ++i) {
      set_vertex(joint.first_extra + static_cast<std::uint32_t>(i), graph_.positions[joint.node] + joint.hull.extra[i],
                 thickest(joint));
    }
  }

  // The texture coordinate of a point near a joint as a branch has it; of the possible u, the one nearest to `near_u`.
  glm::dvec2 texture_as(std::uint32_t node, std::uint32_t branch, const glm::vec3& position, double near_u) const {
    const Tube& tube = tubes_[branch];
    const Vec3 p = Vec3(position) - graph_.positions[node];
    const double u = std::atan2(glm::dot(p, tube.frame.forward), glm::dot(p, tube.frame.side)) / kTurn;
    const double t = glm::dot(p, tube.frame.growth) + (node == branch ? tube.length : 0);
    return {u + std::round(near_u - u), tube.v + t * tube.v_per_length};
  }

  void write_joint(const Joint& joint) {
    write_extra_vertices(joint);
    const auto ring_corners = static_cast<std::uint32_t>(joint.branches.size()) * count_;
    std::size_t next = joint.first_triangle;
    for (const auto& triangle : joint.hull.triangles) {
      std::array<std::uint32_t, 3>& corners = mesh_.triangles[next];
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t corner = triangle[i];
        corners[i] = corner < ring_corners ? row_at(joint.node, joint.branches[corner / count_]) + corner % count_
                                           : joint.first_extra + corner - ring_corners;
      }
      const std::uint32_t own = joint.first_texture + static_cast<std::uint32_t>(next - joint.first_triangle) * 3;
      write_joint_texture(joint, triangle, corners, own, mesh_.texture_triangles[next]);
      ++next;
    }
  }

  // A triangle with an edge of a ring continues that branch's texture; others are textured as on the thickest branch.
  void write_joint_texture(const Joint& joint, const std::array<std::uint32_t, 3>& triangle,
                           const std::array<std::uint32_t, 3>& corners, std::uint32_t own,
                           std::array<std::uint32_t, 3>& texture) {
    const auto ring_corners = static_cast<std::uint32_t>(joint.branches.size()) * count_;
    for (int i = 0; i < 3; ++i) texture[i] = own + static_cast<std::uint32_t>(i);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      if (a >= ring_corners || b >= ring_corners || a / count_ != b / count_) continue;
      const std::uint32_t branch = joint.branches[a / count_], first = texture_row_at(joint.node, branch);
      std::uint32_t from = a % count_, to = b % count_;
      if (from == count_ - 1 && to == 0) to = count_;
      if (to == count_ - 1 && from == 0) from = count_;
      texture[i] = first + from;
      texture[(i + 1) % 3] = first + to;
      const int third = (i + 2) % 3;
      mesh_.texture[own + static_cast<std::uint32_t>(third)] =
          glm::vec2(texture_as(joint.node, branch, mesh_.positions[corners[third]], (from + to) / (2.0 * count_)));
      return;
    }
    const std::uint32_t branch = thickest(joint);
    double near_u = 0.5;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const glm::dvec2 coordinate = texture_as(joint.node, branch, mesh_.positions[corners[i]], near_u);
      near_u = coordinate.x;
      mesh_.texture[own + i] = glm::vec2(coordinate);
    }
  }

  // Refinement must neither round a branch's end nor shorten it.
  void set_sharpness() {
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (graph_.gone[i]) continue;
      const Tube& tube = tubes_[i];
      const auto sharpen = [&](std::uint32_t first) {
        for (std::uint32_t j = 0; j < count_; ++j) {
          mesh_.sharp_edges.push_back({{first + j, first + (j + 1) % count_}});
        }
      };
      if (tube.base_cap) sharpen(row(tube, 0));
      if (tube.tip_cap) sharpen(row(tube, tube.segments));
      if (tube.pointed) mesh_.sharp_vertices.push_back({row(tube, tube.segments)});
    }
  }

  const Skeleton& skeleton_;
  const HullOptions& options_;
  const std::uint32_t count_;  // vertices of a ring
  const double finest_;
  const HullGraph graph_;
  std::vector<Tube> tubes_;
  std::vector<Joint> joints_;
  std::int32_t youngest_ = 0;
  ControlMesh mesh_;
};

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check(const Skeleton& skeleton, const HullOptions& options) {
  if (options.ring_vertices < 3 || options.ring_vertices > 64) {
    throw InputError(fmt::format("expected rings of 3 to 64 vertices, not of {}", options.ring_vertices));
  }
  if (options.max_segments < 1) {
    throw InputError(fmt::format("expected at least one segment for an internode, not {}", options.max_segments));
  }
  if (!(options.thinnest_ring > 0 && options.thinnest_ring <= 1)) {
    throw InputError(fmt::format("expected a thinnest ring above 0 and up to 1, not {}", options.thinnest_ring));
  }
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    const Internode& internode = skeleton.internodes[i];
    if (internode.parent < kNoInternode || internode.parent >= static_cast<InternodeId>(i)) {
      throw InputError(
          fmt::format("internode {} has the parent {}, which does not come before it", i, internode.parent));
    }
    if (!is_finite(internode.base) || !is_finite(internode.tip)) {
      throw InputError(fmt::format("internode {} has an end that is not finite", i));
    }
    for (const double radius : {internode.base_radius, internode.tip_radius}) {
      if (!(radius > 0 && std::isfinite(radius))) {
        throw InputError(fmt::format("internode {} has the radius {}; expected a finite one above 0", i, radius));
      }
    }
  }
}

}  // namespace

ControlMesh hull_mesh(const Skeleton& skeleton, const HullOptions& options) {
  check(skeleton, options);
  return Surface(skeleton, options).build();
}

}  // namespace barkridge
