#include "scene/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "bark/dress_mesh.h"
#include "bark/plant_layers.h"
#include "base/error.h"
#include "base/version.h"
#include "lsystem/lst.h"
#include "mesh/write.h"
#include "raytrace/image_file.h"
#include "scene/camera_fit.h"
#include "scene/scene_hash.h"

namespace barkridge {

namespace {

constexpr double kCellsPerThinnestRadius = 0.5;
constexpr double kCellsPerFinestWave = 0.25;

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

// The radius of the thickest branch, or of what a tree written by hand has of a size.
double thickest_radius(const Model& model) {
  double thickest = 0;
  for (const Internode& internode : model.skeleton.internodes) {
    thickest = std::max({thickest, internode.base_radius, internode.tip_radius});
  }
  return thickest > 0 ? thickest : thinnest_radius(model.tree);
}

TextureMapping texture_mapping(const TextureSize& size, const Model& model) {
  const double thickest = thickest_radius(model);
  TextureMapping mapping;
  mapping.width = size.width.value_or(2 * std::numbers::pi * thickest);
  mapping.height = size.height.value_or(mapping.width);
  mapping.followed_radius = size.follows_radius ? thickest : 0;
  return mapping;
}

std::shared_ptr<const SurfaceShader> bark_shader(const Scene& scene, const Model& model) {
  ImageBark image;
  if (scene.bark.kind == BarkKind::kImage) {
    image = {open_texture(scene.bark.image), texture_mapping(scene.texture, model)};
  }
  return make_bark_shader(model.tree, model.skeleton, model.primitives, scene.material, scene.bark, image);
}

}  // namespace

bool has_lsystem(const Scene& scene) { return scene.model.kind == ModelSource::Kind::kLsystem; }
bool has_word(const Scene& scene) { return has_lsystem(scene) || scene.model.kind == ModelSource::Kind::kString; }
bool has_skeleton(const Scene& scene) { return scene.model.kind != ModelSource::Kind::kTree; }

Scene at_time(const Scene& scene, std::optional<double> time) {
  if (time && !has_lsystem(scene)) {
    throw InputError({scene.model.file, 0, 0, ""}, "expected an L-system, which can grow; this model has no times");
  }
  if (time && !(*time <= kMaxGrowthTime)) {
    throw LimitError({scene.model.file, 0, 0, ""},
                     fmt::format("a time of {:g} derivation steps; expected at most {:g}", *time, kMaxGrowthTime));
  }
  Scene then = scene;
  then.turtle.growth.time = time;
  return then;
}

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
  options.time = scene.turtle.growth.time;
  options.keep_cuts = scene.turtle.growth.pipe.tip_radius || scene.turtle.growth.healing_steps;
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
  Skeleton skeleton = scene.model.kind == ModelSource::Kind::kLst
                          ? read_lst(scene.model.text, scene.model.file)
                          : read_skeleton_table(scene.model.text, scene.model.file);
  thicken(skeleton, scene.turtle.growth);
  return skeleton;
}

Model make_model(const Scene& scene, const Listener& listener) {
  if (has_skeleton(scene)) return make_model(scene, make_skeleton(scene, listener));
  return {{}, parse_tree(scene.model.text, scene.model.file)};
}

Model make_model(const Scene& scene, Skeleton skeleton) {
  if (scene.turtle.growth.healing_steps) {
    skeleton = with_scars_of_shed(std::move(skeleton), *scene.turtle.growth.healing_steps);
  }
  PlantTree plant = plant_from_skeleton(prune(std::move(skeleton), scene.cuts, scene.scars), scene.tree);
  return {std::move(plant.skeleton), std::move(plant.tree), std::move(plant.primitives)};
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
  const GrowthOptions& growth = scene.turtle.growth;
  if (growth.time && !growth.pipe.tip_radius) {
    throw InputError({scene.model.file, 0, 0, ""},
                     "the thinnest branches have only begun to grow; expected mesh.cell_size or growth.tip_radius");
  }
  const double thinnest = growth.pipe.tip_radius ? *growth.pipe.tip_radius : thinnest_radius(model);
  if (thinnest == 0) {
    throw InputError({scene.model.file, 0, 0, ""}, "the model is empty; expected mesh.cell_size, which nothing gives");
  }
  return std::min(kCellsPerThinnestRadius * thinnest, kCellsPerFinestWave * finest_wavelength(model.tree));
}

std::shared_ptr<const Field> framed_field(const Scene& scene, std::shared_ptr<const Field> field,
                                          const Listener& listener) {
  if (!scene.turtle.growth.time || scene.turtle.growth.time == scene.sequence.framed_time) return field;
  return compile(make_model(at_time(scene, scene.sequence.framed_time), listener).tree);
}

Mesh make_dressed(Mesh mesh, const Scene& scene, const Model& model) {
  if (!scene.mesh_attributes || mesh.triangles.empty()) return mesh;
  const auto shader = bark_shader(scene, model);
  DressOptions options;
  options.texture = texture_mapping(scene.texture, model);
  options.shader = shader.get();
  options.footprint = cell_size(scene, model);
  return dressed(std::move(mesh), model.tree, model.skeleton, model.primitives, options);
}

RenderScene make_render_scene(const Scene& scene, const Model& model, const Field& field) {
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
  look.ground.surrounded = field.support();
  look.material = scene.material;
  look.shader = bark_shader(scene, model);
  if (scene.image_layers) {
    look.layers =
        make_plant_layers(model.tree, model.skeleton, model.primitives, texture_mapping(scene.texture, model));
  }
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
