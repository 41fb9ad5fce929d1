#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

#include "base/error.h"
#include "base/version.h"
#include "cli/option_values.h"
#include "scene/scene_keys.h"

namespace barkridge::cli {

namespace {

constexpr const char* kSceneHelp =
    "A scene file (.toml), or directly an L-system (.l), a cpfg string (.str, .lstring), a skeleton table (.skel) "
    "or an LST file (.lst), which then has the default look";

constexpr const char* kExitHelp =
    "Exit status: 0 done; 1 failure (disk full, target not writable, out of memory); 2 bad usage or input; "
    "130, 143 ended by SIGINT, SIGTERM.";

// Breaks lines at blanks so that none is longer than `width`.
std::string wrapped(const std::string& text, std::size_t width) {
  std::string lines;
  std::size_t length = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", i), text.size());
    if (length > 0 && length + 1 + (end - i) > width) {
      lines += '\n';
      length = 0;
    } else if (length > 0) {
      lines += ' ';
      ++length;
    }
    lines.append(text, i, end - i);
    length += end - i;
    if (end < text.size() && text[end] == '\n') {
      lines += '\n';
      length = 0;
    }
    i = end + 1;
  }
  return lines;
}

[[noreturn]] void refuse(const std::string& origin, const std::string& expected) {
  throw InputError({origin, 0, 0, ""}, "expected " + expected);
}

constexpr std::size_t kOptionColumn = 30, kHelpWidth = 100;
std::string help(const std::string& text) { return wrapped(text, kHelpWidth - kOptionColumn); }
std::string footer(const std::string& text) { return wrapped(text + '\n' + kExitHelp, kHelpWidth); }

// The options of a verb as the user wrote them, before they mean anything.
struct Written {
  std::string scene, size, region, frames, points, steps, seed, samples, cell_size, surface, level, statistics,
      max_modules, max_memory;
  std::vector<std::string> definitions, outputs;
  std::vector<std::string> scenes;
  std::string folder;
  std::size_t most_internodes = StudyArguments{}.most_internodes;
  int threads = 0, turns = StudyArguments{}.turns, places = StudyArguments{}.places;
  bool quiet = false, json = false, attributes = false, layers = false;
};

template <typename Value>
CLI::Option* add(CLI::App& verb, const char* names, Value& value, const char* type, const std::string& text) {
  return verb.add_option(names, value, help(text))->type_name(type);
}

CLI::App& add_verb(CLI::App& app, Written& written, const char* name, const char* text, const std::string& notes,
                   const char* scene_name = "SCENE", const char* scene_text = kSceneHelp) {
  CLI::App& verb = *app.add_subcommand(name, text);
  verb.group("Verbs");
  verb.footer(footer(notes));
  add(verb, scene_name, written.scene, "", scene_text)->required();
  add(verb, "-D,--define", written.definitions, "KEY=VALUE",
      "Sets any key of the scene to a TOML value or a bare word, over what the scene says: -D junction.kind=smooth -D "
      "camera.position=[1,2,3]. `barkridge --help-keys` lists the keys")
      ->allow_extra_args(false);
  add(verb, "--max-modules", written.max_modules, "N", "Most modules that the L-system may make (lsystem.max_modules)");
  add(verb, "--max-memory", written.max_memory, "BYTES",
      "Most bytes for its string, with K, M or G if you like (lsystem.max_memory)");
  verb.add_flag("-q,--quiet", written.quiet, "No progress bar");
  return verb;
}

void add_output_options(CLI::App& verb, Written& written, const char* output_text, bool required = true) {
  add(verb, "--frames", written.frames, "A-B[:STEP]",
      "Makes the growing plant at several times: frame k at k times growth.steps_per_frame derivation steps. Its "
      "number "
      "stands in the output's name instead of #### or %04d. A frame is the same whether it is made alone (--frames 17) "
      "or among others");
  add(verb, "-o,--output", written.outputs, "FILE", output_text)->required(required)->allow_extra_args(false);
  add(verb, "-t,--threads", written.threads, "N",
      "Threads to use; 0, the default, means all. The result is the same for any number")
      ->check(CLI::Range(0, 1024).description(""));
}

void add_surface_options(CLI::App& verb, Written& written) {
  add(verb, "--surface", written.surface, "METHOD",
      "implicit, templates, hull, cylinders or leaf: by the model's field, or by Loop subdivision of a control mesh "
      "(surface.method)");
  add(verb, "--level", written.level, "N",
      "Times that each triangle of a control mesh is split in four (surface.level)");
}

void add_verbs(CLI::App& app, Written& written) {
  CLI::App& render = add_verb(app, written, "render", "Renders a picture to a linear half-float EXR or an sRGB PNG.",
                              "Example: barkridge render poplar.toml -o poplar.exr --size 1536x2048 --spp 16");
  add_output_options(render, written,
                     "The picture; its extension, .exr or .png, says the format. It appears whole or not at all. "
                     "May be given more than once");
  add_surface_options(render, written);
  add(render, "--size", written.size, "WxH", "Size in pixels (image.width, image.height)");
  add(render, "--spp,--samples", written.samples, "N", "Most samples a pixel (image.samples_per_pixel)");
  add(render, "--seed", written.seed, "N", "Seed of the picture's random numbers (image.seed)");
  add(render, "--region", written.region, "WxH+X+Y",
      "Renders this part only, X to the right and Y down from the top left; its pixels are those of the whole picture");

  render.add_flag("--layers", written.layers,
                  help("Gives an EXR further channels: points, normals, deformation, internodes, texture coordinates "
                       "(image.layers)"));

  CLI::App& mesh = add_verb(app, written, "mesh", "Makes a triangle mesh of the surface, closed and manifold.",
                            "Example: barkridge mesh poplar.toml -o poplar.ply --cell-size 0.01");
  add_output_options(mesh, written,
                     "The mesh; its extension, .ply, .obj, .stl, .inc or .pov (POV-Ray), says the format. It appears "
                     "whole or not at all. May be given more than once",
                     false);
  add_surface_options(mesh, written);
  add(mesh, "--statistics", written.statistics, "FILE",
      "Writes what the mesh took, as JSON: seconds of each stage, triangles, peak of memory. Then -o may be left out");
  add(mesh, "--cell-size", written.cell_size, "H",
      "Edge length of the sampling cells in scene units (mesh.cell_size); by default half the thinnest branch's "
      "radius, and at most a quarter of the finest displacement's wavelength");

  mesh.add_flag("--attributes", written.attributes,
                help("Adds texture coordinates, attributes of the vertices and, where bark is not plain, colours "
                     "(mesh.attributes)"));

  CLI::App& grow =
      add_verb(app, written, "grow", "Derives an L-system and prints its string.",
               "Example: barkridge grow poplar.l --steps 4", "FILE", "An L-system (.l), or a scene whose model is one");
  add(grow, "--steps", written.steps, "N", "Derivation steps (lsystem.steps); by default what the L-system says");
  add(grow, "--seed", written.seed, "N",
      "Seed of the stochastic choice (lsystem.seed); by default what the L-system says");

  add_verb(
      app, written, "skeleton", "Prints the skeleton as a table.",
      "First line `# barkridge skeleton 1`, then an internode a line: id parent x0 y0 z0 x1 y1 z1 r0 r1, parents "
      "before children, parent -1 at a root. Where an L-system has marked ridges, cuts and scars it is "
      "`# barkridge skeleton 2`, and lines `ridge id width swelling`, `cut id nx ny nz splinters` and `scar id width "
      "depth stub` follow. A table in a .skel file is a scene again.");

  CLI::App& field =
      add_verb(app, written, "field", "Prints the field and its gradient at points, by the reference evaluator.",
               "Prints `x y z F gx gy gz` with 17 significant digits, a line a point. The surface is "
               "where F is 0.5, the inside where it is more.");
  add(field, "--points", written.points, "FILE",
      "Lines `x y z`, blank lines and # comments allowed; - reads the standard input")
      ->required();

  CLI::App& info = add_verb(app, written, "info", "Prints what the model consists of: counts, depth, bounds, memory.",
                            "Example: barkridge info poplar.toml --json");
  info.add_flag("--json", written.json, "As one JSON object");

  CLI::App& study = *app.add_subcommand("study", "Compares implicit and subdivision surfaces, and writes a report.");
  study.group("Verbs");
  study.footer(footer(
      "Writes report.html, which needs no other file, report.json, and a CSV file a table. Runs take turns, each in a "
      "process of its own; with the large trees it takes half an hour. Example: barkridge study -o study --largest "
      "2047"));
  add(study, "SCENES", written.scenes, "",
      "Scenes whose models have skeletons; by default the study's own models, which it writes into the folder");
  add(study, "-o,--output", written.folder, "FOLDER", "The folder to write to; it is made if need be")->required();
  add(study, "--largest", written.most_internodes, "N", "Most internodes of its own models; by default 200000");
  add(study, "--places", written.places, "N", "Places on each model where errors are measured; by default 24")
      ->check(CLI::Range(1, 100000).description(""));
  add(study, "--turns", written.turns, "N", "Times that everything is measured; by default 3")
      ->check(CLI::Range(1, 1000).description(""));
  add(study, "-t,--threads", written.threads, "N", "Threads of each run; 0, the default, means all")
      ->check(CLI::Range(0, 1024).description(""));
  study.add_flag("-q,--quiet", written.quiet, "No progress bar");
}

// Options that stand for keys of the scene become overrides, so that the scene's table alone decides what is right.
void add_override(SceneArguments& arguments, const char* option, const char* key, const std::string& value) {
  if (!value.empty()) arguments.overrides.push_back({key, value, fmt::format("{} {}", option, value)});
}

void interpret_scene_options(const Written& written, SceneArguments& arguments) {
  arguments.path = written.scene;
  arguments.quiet = written.quiet;
  for (const std::string& definition : written.definitions) arguments.overrides.push_back(parse_override(definition));
  add_override(arguments, "--max-modules", "lsystem.max_modules", written.max_modules);
  if (!written.max_memory.empty()) {
    const std::string origin = "--max-memory " + written.max_memory;
    const std::optional<std::uint64_t> bytes = bytes_of(written.max_memory);
    if (!bytes) refuse(origin, "a number of bytes, like 500000000 or 2G");
    arguments.overrides.push_back({"lsystem.max_memory", fmt::format("{}", *bytes), origin});
  }
}

void interpret_output_options(const Written& written, OutputArguments& arguments) {
  interpret_scene_options(written, arguments);
  add_override(arguments, "--surface", "surface.method", written.surface);
  add_override(arguments, "--level", "surface.level", written.level);
  arguments.outputs = written.outputs;
  if (written.frames.empty()) return;
  arguments.frames = frame_range_of(written.frames);
  if (!arguments.frames) {
    refuse("--frames " + written.frames, "numbers of frames up to 1000000, like 17, 0-100 or 0-100:5");
  }
}

Verb interpret_render(const Written& written) {
  RenderArguments arguments;
  interpret_output_options(written, arguments);
  if (!written.size.empty()) {
    const std::string origin = "--size " + written.size;
    const auto size = integers_between(written.size, "x");
    if (!size) refuse(origin, "width and height in pixels, like 768x1024");
    arguments.overrides.push_back({"image.width", fmt::format("{}", (*size)[0]), origin});
    arguments.overrides.push_back({"image.height", fmt::format("{}", (*size)[1]), origin});
  }
  add_override(arguments, "--spp", "image.samples_per_pixel", written.samples);
  add_override(arguments, "--seed", "image.seed", written.seed);
  if (written.layers) arguments.overrides.push_back({"image.layers", "true", "--layers"});
  if (!written.region.empty()) {
    arguments.region_origin = "--region " + written.region;
    const auto region = integers_between(written.region, "x++");
    if (!region || (*region)[0] == 0 || (*region)[1] == 0) {
      refuse(arguments.region_origin, "width, height and place in pixels, like 256x256+128+0");
    }
    arguments.region = {(*region)[2], (*region)[3], (*region)[0], (*region)[1]};
  }
  return arguments;
}

Verb interpret_verb(const std::string& name, const Written& written) {
  if (name == "render") return interpret_render(written);
  if (name == "mesh") {
    MeshArguments arguments;
    interpret_output_options(written, arguments);
    arguments.statistics = written.statistics;
    if (arguments.outputs.empty() && arguments.statistics.empty()) refuse("mesh", "-o FILE, or --statistics FILE");
    if (arguments.frames && !arguments.statistics.empty()) refuse("--statistics", "no --frames beside it");
    add_override(arguments, "--cell-size", "mesh.cell_size", written.cell_size);
    if (written.attributes) arguments.overrides.push_back({"mesh.attributes", "true", "--attributes"});
    return arguments;
  }
  if (name == "grow") {
    GrowArguments arguments;
    interpret_scene_options(written, arguments);
    add_override(arguments, "--steps", "lsystem.steps", written.steps);
    add_override(arguments, "--seed", "lsystem.seed", written.seed);
    return arguments;
  }
  if (name == "skeleton") {
    SkeletonArguments arguments;
    interpret_scene_options(written, arguments);
    return arguments;
  }
  if (name == "field") {
    FieldArguments arguments;
    interpret_scene_options(written, arguments);
    arguments.points = written.points;
    return arguments;
  }
  if (name == "study") {
    return StudyArguments{written.scenes,  written.folder, written.most_internodes, written.turns, written.places,
                          written.threads, written.quiet};
  }
  InfoArguments arguments;
  interpret_scene_options(written, arguments);
  arguments.json = written.json;
  return arguments;
}

std::string keys_help() {
  std::string text;
  const Scene scene{};
  for (const SceneKey& key : scene_keys()) {
    const std::string value = key.value(scene);
    text += fmt::format("{}{}\n    {}\n    Takes {}.\n", key.name, value.empty() ? "" : " = " + value, key.meaning,
                        key.takes);
  }
  return text;
}

}  // namespace

std::variant<Command, HelpText> parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Barkridge models botanical trees as implicit surfaces, renders them and exports meshes.", "barkridge");
  Written written;
  bool help_keys = false;
  app.set_version_flag("--version", std::string("barkridge ") + version());
  app.add_flag("--help-keys", help_keys, "Lists every key that a scene or -D can set, and exits");
  app.footer(footer("`barkridge VERB --help` explains a verb."));
  app.get_formatter()->column_width(kOptionColumn);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  add_verbs(app, written);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version_text) {
    return HelpText{std::string(version_text.what()) + '\n'};
  } catch (const CLI::CallForHelp&) {
    return HelpText{app.help()};
  } catch (const CLI::ParseError& error) {
    const auto verbs = app.get_subcommands();
    throw InputError(fmt::format("{}\nRun `barkridge{} --help` for help.", error.what(),
                                 verbs.empty() ? "" : ' ' + verbs.front()->get_name()));
  }
  if (help_keys) return HelpText{keys_help()};
  const auto verbs = app.get_subcommands();
  if (verbs.empty())
    throw InputError(
        "expected a verb: render, mesh, grow, skeleton, field, info or study\nRun `barkridge --help` for help.");
  return Command{interpret_verb(verbs.front()->get_name(), written), written.threads};
}

}  // namespace barkridge::cli
