#include "scene/surface.h"

#include "base/error.h"
#include "polygonize/polygonize.h"
#include "subdivision/adaptive.h"
#include "subdivision/cylinder_mesh.h"
#include "subdivision/fractal_noise.h"
#include "subdivision/hull.h"
#include "subdivision/leaf_mesh.h"
#include "subdivision/limit.h"
#include "subdivision/loop.h"
#include "subdivision/template_mesh.h"
#include "subdivision/to_mesh.h"

namespace barkridge {

namespace {

// Loop's limit curve of a regular hexagon is 5/6 as wide, so that branches get the thickness that the skeleton states.
constexpr double kHexagonScale = 1.2;
// And of a square, 2/3.
constexpr double kSquareScale = 1.5;

Skeleton thickened(Skeleton skeleton, double factor) {
  for (Internode& internode : skeleton.internodes) {
    internode.base_radius *= factor;
    internode.tip_radius *= factor;
  }
  return skeleton;
}

}  // namespace

bool is_subdivided(const Scene& scene) { return scene.surface.method != SurfaceMethod::kImplicit; }

ControlMesh make_control_mesh(const Scene& scene, const Skeleton& skeleton) {
  if (!has_skeleton(scene)) {
    throw InputError({scene.model.file, 0, 0, ""},
                     "expected a model with a skeleton for a control mesh; this one is a tree written by hand");
  }
  StemOptions stem;
  stem.radius_scale = kHexagonScale;
  stem.tip = scene.surface.tip;
  stem.texture = scene.surface.texture;
  switch (scene.surface.method) {
    case SurfaceMethod::kTemplates: {
      TemplateOptions options;
      options.stem = stem;
      return template_mesh(skeleton, options);
    }
    case SurfaceMethod::kHull:
      return hull_mesh(thickened(skeleton, kSquareScale));
    case SurfaceMethod::kCylinders:
      return cylinder_mesh(skeleton, stem);
    case SurfaceMethod::kLeaf:
      return leaf_mesh(skeleton);
    case SurfaceMethod::kImplicit:
      break;
  }
  throw InputError({scene.model.file, 0, 0, ""}, "expected a surface.method that makes a control mesh");
}

Mesh refine(const Scene& scene, const ControlMesh& control, std::size_t max_triangles) {
  LoopOptions options;
  options.max_triangles = max_triangles;
  const SurfaceOptions& wanted = scene.surface;
  if (wanted.noise.amplitude > 0) return to_mesh(subdivide_with_noise(control, wanted.level, wanted.noise, options));
  if (!wanted.max_angle_degrees && !wanted.limit) return to_mesh(subdivide(control, wanted.level, options));
  if (!wanted.max_angle_degrees) return limit_surface(control, wanted.level, options);
  AdaptiveOptions adaptive;
  adaptive.max_angle_degrees = *wanted.max_angle_degrees;
  adaptive.max_level = wanted.level;
  adaptive.loop = options;
  return subdivide_adaptively(control, adaptive);
}

Mesh implicit_mesh(const Scene& scene, const Model& model, const Field& field, std::size_t max_triangles,
                   const Progress& progress) {
  PolygonizeOptions options;
  options.cell_size = cell_size(scene, model);
  options.max_triangles = max_triangles;
  options.progress = progress;
  return polygonize(field, options);
}

}  // namespace barkridge
