// A field cut off by a box is meshed as the part of the solid in the box.

#include "study/field_within.h"

#include <catch2/catch.hpp>

#include "blobtree/tree.h"
#include "mesh/topology.h"
#include "polygonize/polygonize.h"

using namespace barkridge;

TEST_CASE("a capsule cut off by a box is a closed piece as long as the box") {
  BlobTree tree;
  tree.add(Cone{{0, -3, 0}, {0, 3, 0}, 0.5, 0.5});
  const FieldWithin cut(compile(tree), {{-1, -0.2, -1}, {1, 0.4, 1}});
  PolygonizeOptions options;
  options.cell_size = 0.021;
  const MeshReport report = examine(polygonize(cut, options));
  CHECK(report.closed_manifold());
  CHECK(report.components == 1);
  CHECK(report.volume == Approx(M_PI * 0.25 * 0.6).epsilon(0.04));
}

TEST_CASE("a cut field is the whole one inside and nothing outside, and its bounds say so") {
  BlobTree tree;
  tree.add(Cone{{0, -3, 0}, {0, 3, 0}, 0.5, 0.5});
  const auto whole = compile(tree);
  const FieldWithin cut(whole, {{-1, -0.2, -1}, {1, 0.4, 1}});
  const Vec3 points[] = {{0.3, 0.1, 0}, {0.3, 0.5, 0}, {0, -0.3, 0}};
  double wanted[3], values[3], values_again[3];
  Vec3 gradients[3];
  whole->values(points, wanted);
  cut.values(points, values);
  cut.values_and_gradients(points, values_again, gradients);
  CHECK(values[0] == wanted[0]);
  CHECK(values[1] == 0);
  CHECK(values[2] == 0);
  for (int i = 0; i < 3; ++i) CHECK(values[i] == values_again[i]);
  const FieldBounds across = cut.bounds({{-0.1, 0.3, -0.1}, {0.1, 0.5, 0.1}});
  CHECK(across.value.lo <= 0);
  CHECK(across.value.hi >= 0.9);
  CHECK(cut.bounds({{2, 2, 2}, {3, 3, 3}}).value.hi == 0);
  double inside = 0;
  cut.restricted({{0.2, 0, -0.1}, {0.4, 0.2, 0.1}})->values({points, 1}, {&inside, 1});
  CHECK(inside == wanted[0]);
}
