#include "scene/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

#include "base/error.h"
#include "base/version.h"
#include "mesh/write.h"
#include "raytrace/image_file.h"
#include "scene/camera_fit.h"
#include "scene/scene_hash.h"

namespace barkridge {

namespace {

constexpr double kCellsPerThinnestRadius = 0.5;

// Turtle and derivation know modules but not where the model stands: their errors get its name.
template <typename Work>
auto naming_file(const std::string& file, Work work) {
  try {
    return work();
  } catch (const LimitError& error) {
    if (error.where().file.empty()) throw LimitError({file, 0, 0, ""}, error.message());
    throw;
  } catch (const InputError& error) {
    if (error.where().file.empty()) throw InputError({file, 0, 0, ""}, error.message());
    throw;
  }
}

// A bound from below of the factor by which a node makes its children smaller.
struct SmallestScale {
  double operator()(const Taper& taper) const { return std::min(1.0, taper.tip_scale); }
  double operator()(const Affine& affine) const {
    const Mat3 inverse = glm::inverse(affine.linear);
    double largest = 0;
    for (int row = 0; row < 3; ++row) {
      largest = std::max(largest, std::abs(inverse[0][row]) + std::abs(inverse[1][row]) + std::abs(inverse[2][row]));
    }
    return 1 / largest;
  }
  template <typename Other>
  double operator()(const Other&) const {
    return 1;
  }
};

struct PrimitiveRadius {
  double operator()(const Cone& p) const { return std::min(p.base_radius, p.tip_radius); }
  double operator()(const FadedCone& p) const { return std::min(p.base_radius, p.tip_radius); }
  double operator()(const Disc& p) const { return p.radius; }
  double operator()(const Ring& p) const { return p.radius; }
  double operator()(const Polygon& p) const { return p.radius; }
  template <typename Operator>
  double operator()(const Operator&) const {
    return std::numeric_limits<double>::infinity();
  }
};

double thinnest_primitive(const BlobTree& tree) {
  // From the root down, for parents come after their children; 0 marks what the root does not reach.
  std::vector<double> scale(tree.nodes.size(), 0.0);
  if (!scale.empty()) scale[tree.root] = 1;
  double thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    if (scale[i] == 0) continue;
    const Node& node = tree.nodes[i];
    thinnest = std::min(thinnest, scale[i] * std::visit(PrimitiveRadius{}, node.what));
    for (const NodeId child : node.children) scale[child] = scale[i] * std::visit(SmallestScale{}, node.what);
  }
  return thinnest;
}

}  // namespace

bool has_lsystem(const Scene& scene) { return scene.model.kind == ModelSource::Kind::kLsystem; }
bool has_word(const Scene& scene) { return has_lsystem(scene) || scene.model.kind == ModelSource::Kind::kString; }
bool has_skeleton(const Scene& scene) { return scene.model.kind != ModelSource::Kind::kTree; }

Growth grow(const Scene& scene, const Listener& listener) {
  Growth growth;
  if (!has_word(scene)) {
    throw InputError({scene.model.file, 0, 0, ""},
                     "expected an L-system or a string of modules; this model has neither");
  }
  if (!has_lsystem(scene)) {
    growth.word = parse_word(scene.model.text, scene.model.file);
    return growth;
  }
  growth.grammar = parse_grammar(scene.model.text, scene.model.file, scene.defines, listener.notify);
  DeriveOptions options = scene.derivation;
  options.progress = listener.progress;
  options.notify = listener.notify;
  growth.word = naming_file(scene.model.file, [&] { return derive(*growth.grammar, options); });
  return growth;
}

Skeleton draw(const Scene& scene, const Growth& growth, const Listener& listener) {
  TurtleOptions options = scene.turtle;
  options.notify = listener.notify;
  const Grammar* const grammar = growth.grammar ? &*growth.grammar : nullptr;
  return naming_file(scene.model.file, [&] { return interpret(growth.word, grammar, options); });
}

Skeleton make_skeleton(const Scene& scene, const Listener& listener) {
  if (has_word(scene)) return draw(scene, grow(scene, listener), listener);
  if (!has_skeleton(scene)) {
    throw InputError({scene.model.file, 0, 0, ""},
                     "expected a model with a skeleton; this one is a tree written by hand");
  }
  return read_skeleton_table(scene.model.text, scene.model.file);
}

Model make_model(const Scene& scene, const Listener& listener) {
  if (has_skeleton(scene)) return make_model(scene, make_skeleton(scene, listener));
  return {{}, parse_tree(scene.model.text, scene.model.file)};
}

Model make_model(const Scene& scene, Skeleton skeleton) {
  Model model;
  model.tree = tree_from_skeleton(skeleton, scene.tree);
  model.skeleton = std::move(skeleton);
  return model;
}

double thinnest_radius(const Model& model) {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Internode& internode : model.skeleton.internodes) {
    thinnest = std::min({thinnest, internode.base_radius, internode.tip_radius});
  }
  if (model.skeleton.internodes.empty()) thinnest = thinnest_primitive(model.tree);
  return std::isfinite(thinnest) ? thinnest : 0;
}

double cell_size(const Scene& scene, const Model& model) {
  if (scene.cell_size) return *scene.cell_size;
  const double thinnest = thinnest_radius(model);
  if (thinnest == 0) {
    throw InputError({scene.model.file, 0, 0, ""}, "the model is empty; expected mesh.cell_size, which nothing gives");
  }
  return kCellsPerThinnestRadius * thinnest;
}

RenderScene make_render_scene(const Scene& scene, const Field& field) {
  const double aspect = static_cast<double>(scene.image.width) / scene.image.height;
  RenderScene look;
  look.camera = fit_camera(scene.camera, field, aspect);
  look.sun.direction =
      scene.sun.direction.value_or(direction_of_angles(scene.sun.azimuth_degrees, scene.sun.elevation_degrees));
  look.sun.color = scene.sun.color;
  look.sun.intensity = scene.sun.intensity;
  look.sun.angle_degrees = scene.sun.angle_degrees;
  look.sky = scene.sky;
  look.ground = scene.ground;
  look.material = scene.material;
  return look;
}

void write_picture(const Image& image, const Scene& scene, const Model& model, const std::string& path) {
  write_image(image, path,
              {{"barkridge/version", version()},
               {"barkridge/scene_sha256", scene_hash(scene, model)},
               {"barkridge/seed", fmt::format("{}", scene.image.seed)},
               {"barkridge/samples_per_pixel", fmt::format("{}", scene.image.samples_per_pixel)}});
}

void write_surface(const Mesh& mesh, const Scene& scene, const Model& model, const std::string& path) {
  write_mesh(mesh, path, {fmt::format("barkridge {}, scene {}", version(), scene_hash(scene, model))});
}

}  // namespace barkridge
