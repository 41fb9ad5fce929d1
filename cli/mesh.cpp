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
  for (const std::string& output : arguments.outputs) check_writable(output);

  ProgressBar bar(arguments.quiet);
  const Model model = make_model(scene, {bar.stage("growing"), warn});
  PolygonizeOptions options;
  options.cell_size = cell_size(scene, model);
  options.max_triangles = scene.max_triangles.value_or(machine_memory() / kBytesPerTriangle);
  options.progress = bar.stage("meshing");
  const Mesh mesh = make_dressed(polygonize(*compile(model.tree), options), scene, model);
  for (const std::string& output : arguments.outputs) write_surface(mesh, scene, model, output);
}

}  // namespace barkridge::cli
