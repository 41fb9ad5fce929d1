#include "base/machine_memory.h"
#include "cli/output_check.h"
#include "cli/progress_bar.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "cli/work_statistics.h"
#include "lsystem/limbs.h"
#include "lsystem/prune.h"
#include "mesh/write.h"
#include "scene/pipeline.h"
#include "scene/surface.h"

namespace barkridge::cli {

namespace {

// While a mesh is made and written.
constexpr std::size_t kBytesPerTriangle = 128;

struct Made {
  Model model;
  Mesh mesh;
};

Made make(const Scene& scene, ProgressBar& bar, const std::string& title, StageClock clock,
          WorkStatistics& statistics) {
  const std::size_t limit = scene.max_triangles.value_or(machine_memory() / kBytesPerTriangle);
  const Listener growing{bar.stage(title + "growing"), warn};
  Made made;
  if (is_subdivided(scene)) {
    made.model.skeleton = prune(make_skeleton(scene, growing), scene.cuts, scene.scars);
    statistics.skeleton_seconds = clock.lap();
    const ControlMesh control = make_control_mesh(scene, made.model.skeleton);
    statistics.control_triangles = control.triangles.size();
    statistics.build_seconds = clock.lap();
    made.mesh = refine(scene, control, limit);
  } else {
    if (has_skeleton(scene)) {
      Skeleton skeleton = make_skeleton(scene, growing);
      statistics.skeleton_seconds = clock.lap();
      made.model = make_model(scene, std::move(skeleton));
    } else {
      made.model = make_model(scene, growing);
    }
    const std::shared_ptr<const Field> field = compile(made.model.tree);
    statistics.build_seconds = clock.lap();
    made.mesh = implicit_mesh(scene, made.model, *field, limit, bar.stage(title + "meshing"));
    made.mesh = make_dressed(std::move(made.mesh), scene, made.model);
  }
  statistics.surface_seconds = clock.lap();
  statistics.internodes = made.model.skeleton.internodes.size();
  statistics.triangles = made.mesh.triangles.size();
  return made;
}

}  // namespace

void run(const MeshArguments& arguments) {
  const StageClock clock;
  for (const std::string& output : arguments.outputs) mesh_format(output);
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  const std::vector<Frame> frames = frames_of(arguments.frames, arguments.outputs, scene.sequence);
  for (const Frame& frame : frames) {
    for (const std::string& output : frame.outputs) check_writable(output);
  }
  if (!arguments.statistics.empty()) check_writable(arguments.statistics);

  ProgressBar bar(arguments.quiet);
  WorkStatistics statistics;
  for (const Frame& frame : frames) {
    const Scene now = frame.time ? at_time(scene, frame.time) : scene;
    const Made made = make(now, bar, frame.title, clock, statistics);
    if (!arguments.statistics.empty()) statistics.crossing_limbs = crossing_limbs(made.model.skeleton);
    for (const std::string& output : frame.outputs) write_surface(made.mesh, now, made.model, output);
  }
  if (!arguments.statistics.empty()) statistics.write(arguments.statistics);
}

}  // namespace barkridge::cli
