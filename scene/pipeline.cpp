#include "scene/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
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
  model.skeleton = prune(std::move(skeleton), scene.cuts, scene.scars);
  model.tree = tree_from_skeleton(model.skeleton, scene.tree);
  return model;
}

double thinnest_radius(const Model& model) {
  if (model.skeleton.internodes.empty()) return thinnest_radius(model.tree);
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Internode& internode : model.skeleton.internodes) {
    thinnest = std::min({thinnest, internode.base_radius, internode.tip_radius});
  }
  return thinnest;
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
               {"barkridge/bounces", fmt::format("{}", scene.image.bounces)},
               {"barkridge/samples_per_pixel", fmt::format("{}", scene.image.samples_per_pixel)}});
}

void write_surface(const Mesh& mesh, const Scene& scene, const Model& model, const std::string& path) {
  write_mesh(mesh, path, {fmt::format("barkridge {}, scene {}", version(), scene_hash(scene, model))});
}

}  // namespace barkridge
