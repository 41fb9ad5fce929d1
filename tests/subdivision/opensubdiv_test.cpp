// OpenSubdiv's Loop scheme is the second opinion on every level of refinement.

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "subdivision/loop.h"
#include "tests/subdivision/meshes.h"

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using namespace barkridge;
using namespace barkridge::test;

namespace {

// What OpenSubdiv interpolates: doubles, so that all rounding is ours.
template <int length>
struct Value {
  glm::vec<length, double> value{0};
  void Clear(void* = nullptr) { value = glm::vec<length, double>(0); }
  void AddWithWeight(const Value& other, double weight) { value += weight * other.value; }
};

template <class Vector>
auto to_values(const std::vector<Vector>& vectors) {
  std::vector<Value<Vector::length()>> values;
  for (const Vector& v : vectors) values.push_back({glm::vec<Vector::length(), double>(v)});
  return values;
}

std::unique_ptr<Far::TopologyRefiner> refine(const ControlMesh& mesh, int levels, bool keep_corners) {
  std::vector<int> sizes(mesh.triangles.size(), 3), corners, texture, creases, sharp;
  std::vector<float> crease_weights, sharp_weights;
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  for (const auto& t : mesh.texture_triangles) texture.insert(texture.end(), t.begin(), t.end());
  const auto weight = [](float sharpness) { return std::min(sharpness, 10.0F); };  // 10 is for ever there
  // Where an edge or vertex is named twice we take the greater sharpness, it the last.
  std::map<std::array<std::uint32_t, 2>, float> edges;
  std::map<std::uint32_t, float> vertices;
  for (const auto& s : mesh.sharp_edges) {
    const auto [a, b] = s.vertices;
    edges[{std::min(a, b), std::max(a, b)}] = std::max(edges[{std::min(a, b), std::max(a, b)}], weight(s.sharpness));
  }
  for (const auto& s : mesh.sharp_vertices) vertices[s.vertex] = std::max(vertices[s.vertex], weight(s.sharpness));
  for (const auto& [ends, sharpness] : edges) {
    creases.insert(creases.end(), ends.begin(), ends.end());
    crease_weights.push_back(sharpness);
  }
  for (const auto& [vertex, sharpness] : vertices) {
    sharp.push_back(static_cast<int>(vertex));
    sharp_weights.push_back(sharpness);
  }

  Far::TopologyDescriptor topology;
  topology.numVertices = static_cast<int>(mesh.positions.size());
  topology.numFaces = static_cast<int>(mesh.triangles.size());
  topology.numVertsPerFace = sizes.data();
  topology.vertIndicesPerFace = corners.data();
  topology.numCreases = static_cast<int>(crease_weights.size());
  topology.creaseVertexIndexPairs = creases.data();
  topology.creaseWeights = crease_weights.data();
  topology.numCorners = static_cast<int>(sharp.size());
  topology.cornerVertexIndices = sharp.data();
  topology.cornerWeights = sharp_weights.data();
  Far::TopologyDescriptor::FVarChannel channel;
  channel.numValues = static_cast<int>(mesh.texture.size());
  channel.valueIndices = texture.data();
  topology.numFVarChannels = mesh.texture_triangles.empty() ? 0 : 1;
  topology.fvarChannels = &channel;

  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(keep_corners ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                                   : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_BOUNDARIES);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(topology, Factory::Options(Sdc::SCHEME_LOOP, options)));
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  return refiner;
}

// Our number of every vertex of OpenSubdiv's next level, given that for this level and the triangles of ours.
std::vector<std::uint32_t> match(const Far::TopologyLevel& level, const std::vector<std::uint32_t>& ours,
                                 const ControlMesh& coarse, const ControlMesh& fine, int next_vertices) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> middle;
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = coarse.triangles[t][i], b = coarse.triangles[t][(i + 1) % 3];
      middle[{std::min(a, b), std::max(a, b)}] = fine.triangles[4 * t + 3][(i + 2) % 3];
    }
  }
  std::vector<std::uint32_t> next(static_cast<std::size_t>(next_vertices));
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    next[static_cast<std::size_t>(level.GetVertexChildVertex(v))] = ours[static_cast<std::size_t>(v)];
  }
  for (int e = 0; e < level.GetNumEdges(); ++e) {
    const auto ends = level.GetEdgeVertices(e);
    const std::uint32_t a = ours[static_cast<std::size_t>(ends[0])], b = ours[static_cast<std::size_t>(ends[1])];
    next[static_cast<std::size_t>(level.GetEdgeChildVertex(e))] = middle.at({std::min(a, b), std::max(a, b)});
  }
  return next;
}

// The greatest distance between texture coordinates at the same corners.
double texture_difference(const Far::TopologyLevel& level, const std::vector<std::uint32_t>& ours,
                          const std::vector<Value<2>>& values, const ControlMesh& mesh) {
  std::map<Triangle, std::size_t> triangle_of;  // sorted vertices -> triangle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle key = mesh.triangles[t];
    std::sort(key.begin(), key.end());
    triangle_of[key] = t;
  }
  double worst = 0;
  for (int f = 0; f < level.GetNumFaces(); ++f) {
    const auto corners = level.GetFaceVertices(f);
    const auto texture = level.GetFaceFVarValues(f);
    Triangle key{};
    for (int i = 0; i < 3; ++i) key[static_cast<std::size_t>(i)] = ours[static_cast<std::size_t>(corners[i])];
    Triangle sorted = key;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t t = triangle_of.at(sorted);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto corner =
          std::find(mesh.triangles[t].begin(), mesh.triangles[t].end(), key[i]) - mesh.triangles[t].begin();
      const auto index = mesh.texture_triangles[t][static_cast<std::size_t>(corner)];
      const auto& theirs = values[static_cast<std::size_t>(texture[static_cast<int>(i)])].value;
      worst = std::max(worst, glm::length(glm::dvec2(mesh.texture[index]) - theirs));
    }
  }
  return worst;
}

void compare(const ControlMesh& mesh, int levels, bool keep_corners) {
  const auto refiner = refine(mesh, levels, keep_corners);
  REQUIRE(refiner);
  const Far::PrimvarRefinerReal<double> primvars(*refiner);
  std::vector<Value<3>> positions = to_values(mesh.positions);
  std::vector<Value<2>> texture = to_values(mesh.texture);
  std::vector<std::uint32_t> ours(mesh.positions.size());
  for (std::uint32_t v = 0; v < ours.size(); ++v) ours[v] = v;
  ControlMesh before = mesh;
  LoopOptions options;
  options.keep_corners = keep_corners;
  for (int i = 1; i <= levels; ++i) {
    const Far::TopologyLevel& level = refiner->GetLevel(i);
    const ControlMesh after = subdivide(mesh, i, options);
    REQUIRE(after.positions.size() == static_cast<std::size_t>(level.GetNumVertices()));
    REQUIRE(after.triangles.size() == static_cast<std::size_t>(level.GetNumFaces()));
    ours = match(refiner->GetLevel(i - 1), ours, before, after, level.GetNumVertices());
    std::vector<Value<3>> next(static_cast<std::size_t>(level.GetNumVertices()));
    primvars.Interpolate(i, positions, next);
    positions = std::move(next);
    double worst = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      worst = std::max(worst, glm::length(glm::dvec3(after.positions[ours[v]]) - positions[v].value));
    }
    CAPTURE(i);
    CHECK(worst < 1e-6);
    if (!mesh.texture_triangles.empty()) {
      std::vector<Value<2>> next_texture(static_cast<std::size_t>(level.GetNumFVarValues(0)));
      primvars.InterpolateFaceVarying(i, texture, next_texture);
      texture = std::move(next_texture);
      CHECK(texture_difference(level, ours, texture, after) < 1e-6);
    }
    before = after;
  }
}

}  // namespace

TEST_CASE("regular solids and sheets are refined as by OpenSubdiv") {
  for (const bool keep_corners : {false, true}) {
    compare(octahedron(), 5, keep_corners);
    compare(torus(), 4, keep_corners);
    compare(grid(3, 3), 4, keep_corners);
    compare(tube(4, 6), 4, keep_corners);
  }
}

TEST_CASE("random meshes with holes, creases, corners and seams are refined as by OpenSubdiv at every level") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    compare(random_mesh(seed), 4, seed % 2 == 1);
  }
}

TEST_CASE("a step of several refines as many steps of one") {
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    CAPTURE(seed);
    const ControlMesh mesh = random_mesh(seed);
    ControlMesh steps = mesh;
    for (int i = 0; i < 3; ++i) steps = subdivide(steps, 1);
    const ControlMesh once = subdivide(mesh, 3);
    // Edges are numbered otherwise, so vertices are; triangles are not.
    REQUIRE(steps.triangles.size() == once.triangles.size());
    float worst = 0;
    for (std::size_t t = 0; t < once.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        worst =
            std::max(worst, glm::length(steps.positions[steps.triangles[t][i]] - once.positions[once.triangles[t][i]]));
        worst = std::max(worst, glm::length(steps.texture[steps.texture_triangles[t][i]] -
                                            once.texture[once.texture_triangles[t][i]]));
      }
    }
    CHECK(worst < 1e-6F);
  }
}
