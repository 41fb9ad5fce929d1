#include "study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "base/output_file.h"
#include "polygonize/polygonize.h"
#include "raytrace/image_file.h"
#include "scene/solid_bounds.h"
#include "scene/surface.h"
#include "study/crossings.h"
#include "study/field_within.h"
#include "study/patch.h"
#include "study/surface_error.h"
#include "subdivision/limit.h"
#include "subdivision/loop.h"

namespace barkridge {

namespace {

// A surface ten times finer than the finest setting: cells a tenth as wide; four levels more, sixteen times as fine.
constexpr double kFinerCells = 10;
constexpr int kMoreLevels = 4;
constexpr double kCellFactors[] = {2, 1, 0.5, 0.25};
constexpr int kFinestLevel = 3;
constexpr const char* kSubdivided[] = {"templates", "hull", "cylinders"};
// Windows are as wide as so many of the finest cells, so that the fine surface in one has some 10 000 triangles.
constexpr double kWindowCells = 8;

std::vector<StudySetting> all_settings() {
  std::vector<StudySetting> settings;
  for (const double factor : kCellFactors) settings.push_back({"implicit", factor, 0});
  for (const char* const method : kSubdivided) {
    for (int level = 0; level <= kFinestLevel; ++level) settings.push_back({method, 0, level});
  }
  return settings;
}

double largest_extent(const Box& box) {
  const Vec3 size = box.hi - box.lo;
  return std::max({size.x, size.y, size.z});
}

// A model in this process, for errors and pictures: those do not count.
struct StudiedModel {
  Scene scene;
  Model model;
  std::shared_ptr<const Field> field;
  double thinnest = 0, pixel = 0, area = 0;

  explicit StudiedModel(const std::string& path) : scene(load_scene(path)), model(make_model(scene)) {
    if (model.skeleton.internodes.empty()) {
      throw InputError({path, 0, 0, ""}, "expected a model with a skeleton, which all methods can dress");
    }
    field = compile(model.tree);
    thinnest = thinnest_radius(model);
    pixel = largest_extent(solid_bounds(*field)) / kErrorPixels;
    for (const Internode& i : model.skeleton.internodes) {
      area += std::numbers::pi * (i.base_radius + i.tip_radius) * glm::length(i.tip - i.base);
    }
  }

  Scene with(const StudySetting& setting) const {
    Scene changed = scene;
    changed.surface.method = setting.method == "templates"   ? SurfaceMethod::kTemplates
                             : setting.method == "hull"      ? SurfaceMethod::kHull
                             : setting.method == "cylinders" ? SurfaceMethod::kCylinders
                                                             : SurfaceMethod::kImplicit;
    changed.surface.level = setting.level;
    changed.surface.limit = true;
    changed.surface.max_angle_degrees.reset();
    changed.surface.noise.amplitude = 0;
    if (setting.method == "implicit") changed.cell_size = setting.cell_factor * thinnest;
    return changed;
  }

  // Marching cubes makes some four triangles on the square of a cell.
  double expected_triangles(const StudySetting& setting, std::size_t control_triangles) const {
    if (setting.method != "implicit") return static_cast<double>(control_triangles) * std::pow(4, setting.level);
    return 4 * area / std::pow(setting.cell_factor * thinnest, 2);
  }
};

std::vector<std::string> definitions_of(const StudiedModel& model, const StudySetting& setting) {
  if (setting.method == "implicit") {
    return {"surface.method=implicit", fmt::format("mesh.cell_size={:.17g}", setting.cell_factor * model.thinnest)};
  }
  return {"surface.method=" + setting.method, fmt::format("surface.level={}", setting.level)};
}

// The settings that this model gets, each with its control mesh, if it has one.
struct Candidate {
  StudySetting setting;
  std::shared_ptr<const ControlMesh> control;
  std::vector<RunCosts> runs = {};
};

std::vector<Candidate> candidates_for(const StudyScene& named, const StudiedModel& model, const StudyOptions& options,
                                      std::vector<std::string>& notes) {
  std::vector<Candidate> candidates;
  std::string method;
  std::shared_ptr<const ControlMesh> control;
  for (const StudySetting& setting : all_settings()) {
    if (setting.method != "implicit" && setting.method != method) {
      control = nullptr;
      try {
        control = std::make_shared<ControlMesh>(make_control_mesh(model.with(setting), model.model.skeleton));
      } catch (const InputError& error) {
        notes.push_back(fmt::format("{}, {}: {}", named.name, setting.method, error.message()));
      }
    }
    method = setting.method;
    if (setting.method != "implicit" && !control) continue;
    const double expected = model.expected_triangles(setting, control ? control->triangles.size() : 0);
    if (expected > static_cast<double>(options.max_triangles)) {
      notes.push_back(fmt::format("{}, {}, {}: left out, for it would have some {:.0f} million triangles", named.name,
                                  setting.method, setting.name(), expected / 1e6));
      continue;
    }
    candidates.push_back({setting, setting.method == "implicit" ? nullptr : control});
  }
  return candidates;
}

FineSurface fine_surface(const StudiedModel& model, const Candidate& candidate) {
  if (!candidate.control) {
    const double cell = kCellFactors[std::size(kCellFactors) - 1] * model.thinnest / kFinerCells;
    return [&model, cell](const Box& box) {
      PolygonizeOptions options;
      options.cell_size = cell;
      return polygonize(FieldWithin(model.field, grown(box, 4 * cell)), options);
    };
  }
  return [control = candidate.control](const Box& box) {
    return limit_surface(patch_for(subdivide(patch_for(*control, box), kFinestLevel), box), kMoreLevels);
  };
}

Mesh mesh_of(const StudiedModel& model, const Candidate& candidate) {
  const Scene scene = model.with(candidate.setting);
  return candidate.control ? refine(scene, *candidate.control, 0) : implicit_mesh(scene, model.model, *model.field, 0);
}

ReportPicture picture_of(const StudyScene& named, const StudiedModel& model, const Candidate& candidate,
                         const Mesh& mesh, const StudyOptions& options) {
  Scene scene = model.with(candidate.setting);
  scene.image.width = scene.image.height = options.picture;
  const Image image = render(mesh, make_render_scene(scene, model.model, *model.field), scene.image);
  const std::string path = fmt::format("{}/{}_{}.png", options.picture_folder, named.name, candidate.setting.method);
  write_image(image, path);
  return {fmt::format("{}: {}, {}, {} triangles", named.name, candidate.setting.method, candidate.setting.name(),
                      mesh.triangles.size()),
          read_file(path)};
}

Times times_over(const std::vector<RunCosts>& runs, double (*seconds)(const RunCosts&)) {
  std::vector<double> all;
  for (const RunCosts& run : runs) all.push_back(seconds(run));
  return times_of(std::move(all));
}

Measurement measurement_of(const StudyScene& named, const Candidate& candidate) {
  Measurement m;
  m.model = named.name;
  m.method = candidate.setting.method;
  m.setting = candidate.setting.name();
  m.internodes = candidate.runs.front().internodes;
  m.crossing_limbs = candidate.runs.front().crossing_limbs;
  m.triangles = candidate.runs.front().triangles;
  for (const RunCosts& run : candidate.runs) m.peak_bytes = std::max(m.peak_bytes, run.peak_bytes);
  m.skeleton = times_over(candidate.runs, [](const RunCosts& r) { return r.skeleton; });
  m.build = times_over(candidate.runs, [](const RunCosts& r) { return r.build; });
  m.surface = times_over(candidate.runs, [](const RunCosts& r) { return r.surface; });
  m.total = times_over(candidate.runs, [](const RunCosts& r) { return r.skeleton + r.build + r.surface; });
  return m;
}

// Pictures are shown of what the thesis compares: its resolution of two levels, and cells of half the thinnest radius.
bool is_shown(const StudySetting& setting) {
  return setting.method == "implicit" ? setting.cell_factor == 0.5 : setting.level == 2;
}

void measure_scene(const StudyScene& named, const MeshRunner& run, const StudyOptions& options,
                   const std::function<void(double)>& done, StudyFindings& findings) {
  const StudiedModel model(named.path);
  std::vector<Candidate> candidates = candidates_for(named, model, options, findings.notes);
  for (int turn = 0; turn < options.turns; ++turn) {
    for (Candidate& candidate : candidates)
      candidate.runs.push_back(run(named.path, definitions_of(model, candidate.setting)));
    done(0.5 * (turn + 1) / options.turns);
  }
  const double finest = kCellFactors[std::size(kCellFactors) - 1] * model.thinnest;
  const std::vector<Box> windows = error_windows(model.model.skeleton, kWindowCells * finest, options.windows);
  // The settings of one method stand together, and have one fine surface.
  for (auto first = candidates.begin(); first != candidates.end();) {
    const auto last = std::find_if(first, candidates.end(),
                                   [&](const Candidate& c) { return c.setting.method != first->setting.method; });
    std::vector<Mesh> meshes;
    for (auto candidate = first; candidate != last; ++candidate) meshes.push_back(mesh_of(model, *candidate));
    const std::vector<DistanceSummary> errors =
        surface_errors(meshes, windows, 4 * model.thinnest, fine_surface(model, *first));
    for (auto candidate = first; candidate != last; ++candidate) {
      const auto i = static_cast<std::size_t>(candidate - first);
      Measurement m = measurement_of(named, *candidate);
      if (errors[i].count > 0) {
        m.pixel = model.pixel;
        m.error = PixelError{errors[i].largest / model.pixel, errors[i].root_mean_square() / model.pixel};
      }
      if (meshes[i].triangles.size() <= options.most_for_crossings) m.crossings = crossing_pairs(meshes[i]);
      findings.measurements.push_back(std::move(m));
      if (is_shown(candidate->setting)) {
        findings.pictures.push_back(picture_of(named, model, *candidate, meshes[i], options));
      }
    }
    first = last;
    done(0.5 + 0.5 * static_cast<double>(first - candidates.begin()) / static_cast<double>(candidates.size()));
  }
}

}  // namespace

std::string StudySetting::name() const {
  if (method != "implicit") return fmt::format("level {}", level);
  return cell_factor == 1 ? "cells of 1 radius" : fmt::format("cells of {:g} radii", cell_factor);
}

StudyFindings measure(const std::vector<StudyScene>& scenes, const MeshRunner& run, const StudyOptions& options) {
  StudyFindings findings;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    measure_scene(
        scenes[i], run, options,
        [&](double share) {
          report(options.progress, (static_cast<double>(i) + share) / static_cast<double>(scenes.size()));
        },
        findings);
  }
  return findings;
}

}  // namespace barkridge
