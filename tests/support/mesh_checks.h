#pragma once

#include <catch2/catch.hpp>

#include "mesh/topology.h"

namespace barkridge::test {

/// Fails the test, naming the first guilty element, unless the mesh is closed, oriented, 2-manifold, and free of
/// triangles without area, of vertices in the same place and of unused ones. Returns what was found.
inline MeshReport require_closed_manifold(const Mesh& mesh) {
  const MeshReport report = examine(mesh);
  INFO(report.first_fault);
  REQUIRE(report.first_fault.empty());
  REQUIRE(report.closed_manifold());
  return report;
}

}  // namespace barkridge::test
