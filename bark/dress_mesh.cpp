#include "bark/dress_mesh.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <map>
#include <tuple>

#include "blobtree/surface_probe.h"

namespace barkridge {

namespace {

constexpr NodeId kNoPrimitive = ~NodeId{0};

class Dresser {
 public:
  Dresser(Mesh mesh, const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives,
          const DressOptions& options)
      : mesh_(std::move(mesh)), probe_(tree), coordinates_(tree, skeleton, primitives), options_(options) {}

  Mesh run() {
    visit_vertices();
    visit_triangles();
    return std::move(mesh_);
  }

 private:
  // Of all that a vertex is made of, the largest share. Vertices off the surface, by a cell where a sliver was left
  // out, may have none.
  void visit_vertices() {
    const std::size_t count = mesh_.positions.size();
    std::vector<float> deformation(count), ridge(count);
    std::vector<std::int32_t> internode(count, kNoInternode);
    main_.assign(count, kNoPrimitive);
    mesh_.texture.resize(count);
    if (options_.shader) mesh_.colors.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      thread_local SurfaceSample sample;
      const Vec3 point(mesh_.positions[i]);
      probe_.at(point, sample);
      deformation[i] = static_cast<float>(sample.deformation);
      ridge[i] = static_cast<float>(sample.ridge);
      if (options_.shader) {
        mesh_.colors[i] =
            glm::vec3(options_.shader->shade(point, Vec3(mesh_.normals[i]), options_.footprint).material.color);
      }
      const SurfaceShare* largest = largest_share(sample);
      if (!largest) return;
      main_[i] = largest->primitive;
      internode[i] = coordinates_.of(largest->primitive).internode;
      mesh_.texture[i] = texture_at(*largest);
    });
    mesh_.attributes.push_back({"deformation", std::move(deformation)});
    mesh_.attributes.push_back({"ridge", std::move(ridge)});
    mesh_.attributes.push_back({"internode", std::move(internode)});
  }

  glm::vec2 texture_at(const SurfaceShare& share) const {
    const BranchFrame& frame = coordinates_.of(share.primitive);
    return glm::vec2(texture_coordinates(options_.texture, frame, branch_point(frame, share.point)));
  }

  // Coordinates of a vertex in a primitive where another has the largest share; its own where this one has none at all.
  glm::vec2 texture_in(NodeId primitive, std::uint32_t vertex) {
    probe_.at(Vec3(mesh_.positions[vertex]), sample_);
    for (const SurfaceShare& share : sample_.shares) {
      if (share.primitive == primitive) return texture_at(share);
    }
    return mesh_.texture[vertex];
  }

  NodeId main_of(const std::array<std::uint32_t, 3>& triangle) const {
    const NodeId a = main_[triangle[0]], b = main_[triangle[1]], c = main_[triangle[2]];
    const NodeId most = b == c ? b : a;
    return most != kNoPrimitive ? most : b != kNoPrimitive ? b : c;
  }

  // Every vertex has its own coordinates under its own number; others follow, each once.
  void visit_triangles() {
    std::map<std::tuple<std::uint32_t, NodeId, int>, std::uint32_t> others;
    mesh_.texture_triangles.reserve(mesh_.triangles.size());
    for (const auto& triangle : mesh_.triangles) {
      const NodeId primitive = main_of(triangle);
      const float repeats = primitive == kNoPrimitive
                                ? 1
                                : static_cast<float>(texture_repeats(options_.texture, coordinates_.of(primitive)));
      std::array<std::uint32_t, 3>& corners = mesh_.texture_triangles.emplace_back();
      float first_u = 0;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = triangle[corner];
        const bool is_own = main_[vertex] == primitive || main_[vertex] == kNoPrimitive;
        glm::vec2 at = is_own ? mesh_.texture[vertex] : texture_in(primitive, vertex);
        // A triangle across the line where the image closes runs on beyond it.
        const int lap = corner == 0 ? 0 : static_cast<int>(std::round((first_u - at.x) / repeats));
        at.x += static_cast<float>(lap) * repeats;
        if (corner == 0) first_u = at.x;
        if (is_own && lap == 0) {
          corners[corner] = vertex;
          continue;
        }
        const auto number = static_cast<std::uint32_t>(mesh_.texture.size());
        const auto [found, is_new] = others.try_emplace({vertex, primitive, lap}, number);
        if (is_new) mesh_.texture.push_back(at);
        corners[corner] = found->second;
      }
    }
  }

  Mesh mesh_;
  SurfaceProbe probe_;
  BranchCoordinates coordinates_;
  const DressOptions& options_;
  std::vector<NodeId> main_;  // by vertex
  SurfaceSample sample_;
};

}  // namespace

Mesh dressed(Mesh mesh, const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives,
             const DressOptions& options) {
  return Dresser(std::move(mesh), tree, skeleton, primitives, options).run();
}

}  // namespace barkridge
