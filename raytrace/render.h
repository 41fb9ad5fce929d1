#pragma once
// The renderer's door: what to look at, from where, in which light; and the picture that comes out.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "blobtree/field.h"
#include "mesh/mesh.h"
#include "raytrace/surface_layers.h"
#include "raytrace/surface_shader.h"

namespace barkridge {

struct Camera {
  enum class Projection { kPerspective, kOrthographic };
  Projection projection = Projection::kPerspective;
  Vec3 position{0, 0, 5};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};
  /// Perspective: full vertical angle of view.
  double fov_degrees = 35;
  /// Orthographic: height of the picture in scene units.
  double height = 2;
};

/// A distant light. The direction points from the scene to the sun.
struct Sun {
  Vec3 direction{0.6, 0.65, 0.45};
  Color color{1.0, 0.94, 0.83};
  /// Irradiance on a surface that faces the sun, divided by pi: a white Lambert surface then has this radiance.
  double intensity = 2.0;
  /// Full angle the sun subtends; 0 gives hard shadows.
  double angle_degrees = 0.53;
};

/// A sky dome, from `horizon` to `zenith` by the direction's height, and `horizon` below; it lights, and it is seen
/// behind everything. With intensity 0 there is none, and the picture is transparent where nothing is hit.
struct Sky {
  Color zenith{0.24, 0.41, 0.78};
  Color horizon{0.78, 0.86, 0.95};
  double intensity = 0.9;
};

/// The horizontal plane y = height. Far away, against the size of a box, it fades into the horizon.
struct Ground {
  bool enabled = true;
  double height = 0;
  Color color{0.25, 0.235, 0.175};
  /// That box; if it is empty, the support of the field.
  Box surrounded;
};

struct RenderScene {
  Camera camera;
  Sun sun;
  Sky sky;
  Ground ground;
  Material material;
  /// Tells the solid's material instead, where there is one.
  std::shared_ptr<const SurfaceShader> shader = {};
  /// What else the picture holds; without them no layers at all.
  std::shared_ptr<const SurfaceLayers> layers = {};
};

/// A rectangle of pixels: x to the right, y down from the top.
struct PixelRegion {
  int x = 0, y = 0, width = 0, height = 0;
};

struct RenderOptions {
  int width = 768, height = 1024;
  /// Most samples a pixel; they are spent where neighbouring samples differ.
  int samples_per_pixel = 9;
  /// 1: light that was scattered once arrives from sky and surfaces around, with their shadows. 0: only the sun has
  /// shadows, and the sky lights every surface as if nothing stood before it.
  int bounces = 1;
  std::uint64_t seed = 0;
  /// The part to render; zero width means all.
  PixelRegion region;
  Progress progress;
};

/// Throw `InputError` that names the setting, as in "camera.fov_degrees" or "spp", and its range. `render` calls both.
void check(const RenderScene& scene);
void check(const RenderOptions& options);

/// A picture or a region of one: linear, premultiplied RGBA, rows from the top. Alpha is 1 wherever there is
/// something to see, the sky included.
struct Image {
  int full_width = 0, full_height = 0;
  PixelRegion region;
  std::vector<float> rgba;  ///< 4 * region.width * region.height
  /// Further numbers of each pixel: of the solid where the ray through its middle meets it first, 0 where none does.
  /// `P.X`, `P.Y`, `P.Z` are the point, `N.X`, `N.Y`, `N.Z` the field's normal; then come those of the scene's layers.
  std::vector<std::string> layer_names = {};
  std::vector<float> layers = {};  ///< layer_names.size() * region.width * region.height
};

/// Renders the solid of `field`. Every pixel is a function of field, scene, seed and its own place in the full picture:
/// not of region, threads or machine load. Rays find the first point of the solid to 1e-6 of the scene's size; nothing
/// is stepped over. Throws `InputError` for settings outside their ranges, `Cancelled`.
Image render(const Field& field, const RenderScene& scene, const RenderOptions& options);
/// The same for a mesh, shaded by its vertex normals, or flat if it has none. An open mesh is seen from both sides.
Image render(const Mesh& mesh, const RenderScene& scene, const RenderOptions& options);

}  // namespace barkridge
