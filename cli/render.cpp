#include "raytrace/render.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "base/machine_memory.h"
#include "cli/output_check.h"
#include "cli/progress_bar.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "raytrace/image_file.h"
#include "scene/pipeline.h"
#include "scene/surface.h"

namespace barkridge::cli {

namespace {

void check_region(const RenderArguments& arguments, const RenderOptions& picture) {
  const PixelRegion& region = arguments.region;
  const bool inside = std::int64_t{region.x} + region.width <= picture.width &&
                      std::int64_t{region.y} + region.height <= picture.height;
  if (!inside) {
    throw InputError(
        {arguments.region_origin, 0, 0, ""},
        fmt::format("expected a part of the picture, which has {} x {} pixels", picture.width, picture.height));
  }
}

// A picture that the memory cannot hold would be killed by the system after hours, without a word.
void check_memory(const RenderOptions& picture, bool has_layers) {
  const double bytes_per_pixel = has_layers ? 160 : 48;
  const bool whole = picture.region.width == 0;
  const double pixels = static_cast<double>(whole ? picture.width : picture.region.width) *
                        static_cast<double>(whole ? picture.height : picture.region.height);
  const double needed = bytes_per_pixel * pixels, present = static_cast<double>(machine_memory());
  if (needed > present) {
    throw std::runtime_error(fmt::format(
        "the picture takes {:.1f} GB of memory, and this machine has {:.1f} GB; render it in parts with --region",
        needed / 1e9, present / 1e9));
  }
}

// Layers that nothing holds would be made for nothing.
void check_layers(const RenderArguments& arguments, const Scene& scene) {
  if (!scene.image_layers || arguments.outputs.empty()) return;
  for (const std::string& output : arguments.outputs) {
    if (can_hold_layers(output)) return;
  }
  throw InputError({arguments.outputs.front(), 0, 0, ""}, "expected an EXR for the layers (image.layers)");
}

}  // namespace

void run(const RenderArguments& arguments) {
  for (const std::string& output : arguments.outputs) check_image_path(output);
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  check_region(arguments, scene.image);
  RenderOptions options = scene.image;
  options.region = arguments.region;
  check_memory(options, scene.image_layers);
  check_layers(arguments, scene);
  const std::vector<Frame> frames = frames_of(arguments.frames, arguments.outputs, scene.sequence);
  for (const Frame& frame : frames) {
    for (const std::string& output : frame.outputs) check_writable(output);
  }
  prepare_image_writing(arguments.outputs);

  ProgressBar bar(arguments.quiet);
  std::shared_ptr<const Field> framed;
  for (const Frame& frame : frames) {
    const Scene now = frame.time ? at_time(scene, frame.time) : scene;
    const Listener listener{bar.stage(frame.title + "growing"), warn};
    const Model model = make_model(now, listener);
    const std::shared_ptr<const Field> field = compile(model.tree);
    if (!framed) framed = framed_field(now, field, listener);
    const RenderScene look = make_render_scene(now, model, *framed);
    // A codec that cannot be loaded ends the job as soon as that is known.
    options.progress = [&arguments, shown = bar.stage(frame.title + "rendering")](double fraction) {
      prepare_image_writing(arguments.outputs);
      return !shown || shown(fraction);
    };
    const Image image = is_subdivided(now)
                            ? render(refine(now, make_control_mesh(now, model.skeleton), 0), look, options)
                            : render(*field, look, options);
    for (const std::string& output : frame.outputs) write_picture(image, now, model, output);
  }
}

}  // namespace barkridge::cli
