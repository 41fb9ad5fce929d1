#include "mesh/write.h"

#include "cli/machine_memory.h"
#include "cli/output_check.h"
#include "cli/progress_bar.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "polygonize/polygonize.h"
#include "scene/pipeline.h"

namespace barkridge::cli {

namespace {

// While a mesh is made and written.
constexpr std::size_t kBytesPerTriangle = 128;

}  // namespace

void run(const MeshArguments& arguments) {
  for (const std::string& output : arguments.outputs) mesh_format(output);
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  const std::vector<Frame> frames = frames_of(arguments.frames, arguments.outputs, scene.sequence);
  for (const Frame& frame : frames) {
    for (const std::string& output : frame.outputs) check_writable(output);
  }

  ProgressBar bar(arguments.quiet);
  for (const Frame& frame : frames) {
    const Scene now = frame.time ? at_time(scene, frame.time) : scene;
    const Model model = make_model(now, {bar.stage(frame.title + "growing"), warn});
    PolygonizeOptions options;
    options.cell_size = cell_size(now, model);
    options.max_triangles = scene.max_triangles.value_or(machine_memory() / kBytesPerTriangle);
    options.progress = bar.stage(frame.title + "meshing");
    const Mesh mesh = polygonize(*compile(model.tree), options);
    for (const std::string& output : frame.outputs) write_surface(mesh, now, model, output);
  }
}

}  // namespace barkridge::cli
