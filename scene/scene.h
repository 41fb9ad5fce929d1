#pragma once
// All that a scene file can say, as plain values. docs/scene_format.md describes every key.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bark/bark_shader.h"
#include "blobtree/from_skeleton.h"
#include "lsystem/derive.h"
#include "lsystem/prune.h"
#include "lsystem/turtle.h"
#include "raytrace/render.h"
#include "subdivision/fractal_noise.h"
#include "subdivision/stem_options.h"

namespace barkridge {

/// Where the model comes from.
struct ModelSource {
  enum class Kind {
    kLsystem,   ///< an L-system in cpfg's language
    kString,    ///< a string of modules in cpfg's text form
    kSkeleton,  ///< a skeleton table
    kLst,       ///< a skeleton as a list of operations (lsystem/lst.h)
    kTree,      ///< a BlobTree in its text form
  };
  Kind kind = Kind::kTree;
  /// The model's own text. One that stands inside a scene has as many empty lines and blanks before it as it has lines
  /// and characters before it there, so that messages about it have the scene's lines.
  std::string text;
  std::string file;  ///< where the text stands, for messages
};

/// How the model gets its surface.
enum class SurfaceMethod {
  kImplicit,   ///< the field of its BlobTree
  kTemplates,  ///< Loop subdivision of a control mesh of junction templates, for planar joints
  kHull,       ///< Loop subdivision of a control mesh of convex-hull joints, for all
  kCylinders,  ///< Loop subdivision of separate generalized cylinders
  kLeaf,       ///< Loop subdivision of an open sheet along planar axes, whose half widths the radii are
};
struct SurfaceOptions {
  SurfaceMethod method = SurfaceMethod::kImplicit;
  /// Times that each triangle of a control mesh is split in four; with a tolerance, at the most.
  int level = 2;
  /// The greatest angle between triangles, where they are not all split alike.
  std::optional<double> max_angle_degrees;
  /// Whether the refined vertices are moved to the limit surface. Adaptive subdivision always does, noise never.
  bool limit = true;
  /// Bumps that each step adds; none with amplitude 0.
  FractalNoise noise;
  /// Of stems by templates and cylinders.
  StemTip tip = StemTip::kCapped;
  StemTexture texture = StemTexture::kReflected;
};

/// A camera whose place may be left to the program: without a position it stands in the direction given by the angles,
/// as far away as the whole model needs, and magnifies the picture by `zoom`; without a target it looks at the model's
/// middle; without a height an orthographic picture is as high as the model needs.
struct SceneCamera {
  Camera::Projection projection = Camera::Projection::kPerspective;
  std::optional<Vec3> position;
  std::optional<Vec3> target;
  Vec3 up{0, 1, 0};
  double fov_degrees = 35;
  std::optional<double> height;
  /// From +z towards +x, and above the horizon, as seen from the model.
  double azimuth_degrees = -25;
  double elevation_degrees = 8;
  double zoom = 1;
};

/// A sun given by a direction, or by two angles that count like the camera's.
struct SceneSun {
  std::optional<Vec3> direction;
  double azimuth_degrees = 50;
  double elevation_degrees = 41;
  Color color = Sun{}.color;
  double intensity = Sun{}.intensity;
  double angle_degrees = Sun{}.angle_degrees;
};

/// How a sequence of pictures or meshes of a growing plant counts its times.
struct SceneSequence {
  /// Derivation steps from one frame to the next: frame k stands at k times as many.
  double steps_per_frame = 1;
  /// The time of the model that the camera is fitted to, in all frames; without it the grown-up one.
  std::optional<double> framed_time;
};

/// Of the bark that an image covers; a width left out is the thickest branch's circumference, a height the width.
struct TextureSize {
  std::optional<double> width, height;
  bool follows_radius = false;
};

/// A ridge rule as a scene states it: without a width it has the scene's, without a swelling a quarter of its width.
struct SceneRidgeRule {
  Span orders = RidgeRule{}.orders;
  Span angles_degrees = RidgeRule{}.angles_degrees;
  Span radius_ratios = RidgeRule{}.radius_ratios;
  std::optional<double> width;
  std::optional<double> swelling;
};

struct Scene {
  ModelSource model;
  DeriveOptions derivation;
  /// Replacements for values that the L-system defines.
  std::map<std::string, std::string> defines;
  TurtleOptions turtle;
  SceneSequence sequence;
  /// Branches that are missing, in the order of the file.
  std::vector<CutRule> cuts;
  std::vector<ScarRule> scars;
  TreeOptions tree;
  SurfaceOptions surface;
  /// In the order of the file. `load_scene` completes them and puts them into `tree`, too.
  std::vector<SceneRidgeRule> ridges;
  SceneCamera camera;
  SceneSun sun;
  Sky sky;
  Ground ground;
  Material material;
  BarkOptions bark;
  RenderOptions image;
  bool image_layers = false;
  /// Edge length of a mesh's sampling cells; without it `default_cell_size`.
  std::optional<double> cell_size;
  /// Most triangles of a mesh; without it as many as the machine's memory holds.
  std::optional<std::size_t> max_triangles;
  /// Whether meshes get texture coordinates, attributes and, where bark is not plain, colours.
  bool mesh_attributes = false;
  TextureSize texture;
};

/// A value for a key of the scene from outside of its file.
struct Override {
  std::string key;
  std::string value;   ///< a TOML value, or a bare word as text
  std::string origin;  ///< what the user wrote, for messages: "-D junction.kind=smooth"
};

/// Splits `key=value`. Throws `InputError` when there is no key or no `=`.
Override parse_override(const std::string& definition);

/// Reads a scene file (.toml), or an L-system (.l), a cpfg string (.str, .lstring), a skeleton table (.skel) or an
/// LST file (.lst) as a scene with the default look. Overrides replace what the file says; later ones win. The model's
/// text is read too, but not parsed. Paths in a scene file are relative to it, paths in overrides to the working
/// directory. Throws `InputError` with place for a file that cannot be read, for unknown keys, and for values of the
/// wrong type, out of range or not finite.
Scene load_scene(const std::string& path, std::span<const Override> overrides = {});

}  // namespace barkridge
