#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <optional>

#include "base/error.h"
#include "base/version.h"
#include "scene/scene_keys.h"

namespace barkridge::cli {

namespace {

constexpr const char* kSceneHelp =
    "A scene file (.toml), or directly an L-system (.l), a cpfg string (.str, .lstring) or a skeleton table (.skel), "
    "which then has the default look";

constexpr const char* kExitHelp =
    "Exit status: 0 done; 1 failure (disk full, target not writable, out of memory); 2 bad usage or input; "
    "130, 143 ended by SIGINT, SIGTERM.";

[[noreturn]] void refuse(const std::string& origin, const std::string& expected) {
  throw InputError({origin, 0, 0, ""}, "expected " + expected);
}

// Integers with separators between them, like 640x480+10+20 by "x++"; nothing if the text is anything else.
std::optional<std::vector<int>> integers_between(std::string_view text, std::string_view separators) {
  std::vector<int> numbers;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    int number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc() || number < 0) return std::nullopt;
    numbers.push_back(number);
    at = after;
    if (i < separators.size() && (at == end || *at++ != separators[i])) return std::nullopt;
  }
  if (at != end) return std::nullopt;
  return numbers;
}

// A number of bytes with an optional unit K, M, G or T, as a number.
std::string bytes_of(const std::string& text, const std::string& origin) {
  std::uint64_t number = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string unit(after, text.data() + text.size());
  const std::size_t power = std::string_view("KMGT").find(unit.empty() ? '?' : unit[0]);
  const std::uint64_t factor = power == std::string_view::npos ? 1 : std::uint64_t{1} << (10 * (power + 1));
  const bool known = unit.empty() || (unit.size() == 1 && factor > 1);
  if (error != std::errc() || !known || number > (std::uint64_t{1} << 62) / factor) {
    refuse(origin, "a number of bytes, like 500000000 or 2G");
  }
  return fmt::format("{}", number * factor);
}

// The options of a verb as the user wrote them, before they mean anything.
struct Written {
  std::string scene, output, size, region, points, steps, seed, samples, cell_size, max_modules, max_memory;
  std::vector<std::string> definitions;
  int threads = 0;
  bool quiet = false, json = false;
};

void add_scene_options(CLI::App& verb, Written& written, const char* scene_name = "SCENE",
                       const char* help = kSceneHelp) {
  verb.add_option(scene_name, written.scene, help)->required();
  verb.add_option("-D,--define", written.definitions,
                  "Sets any key of the scene to a TOML value or a bare word, over what the scene says: "
                  "-D junction.kind=smooth -D camera.position=[1,2,3]. `barkridge --help-keys` lists the keys")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb.add_option("--max-modules", written.max_modules, "Most modules that the L-system may make (lsystem.max_modules)")
      ->type_name("N");
  verb.add_option("--max-memory", written.max_memory,
                  "Most bytes for its string, with K, M or G if you like (lsystem.max_memory)")
      ->type_name("BYTES");
  verb.add_flag("-q,--quiet", written.quiet, "No progress bar");
}

void add_threads_option(CLI::App& verb, Written& written) {
  verb.add_option("-t,--threads", written.threads,
                  "Threads to use; 0, the default, means all. The result is the same for any number")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
}

void add_render(CLI::App& app, Written& written) {
  CLI::App& verb = *app.add_subcommand("render", "Renders a picture to a linear half-float EXR or an sRGB PNG.");
  add_scene_options(verb, written);
  verb.add_option("-o,--output", written.output,
                  "The picture; its extension, .exr or .png, says the format. It appears whole or not at all")
      ->type_name("FILE")
      ->required();
  verb.add_option("--size", written.size, "Size in pixels (image.width, image.height)")->type_name("WxH");
  verb.add_option("--spp,--samples", written.samples, "Most samples a pixel (image.samples_per_pixel)")->type_name("N");
  verb.add_option("--seed", written.seed, "Seed of the picture's random numbers (image.seed)")->type_name("N");
  verb.add_option("--region", written.region,
                  "Renders this part only, X to the right and Y down from the top left; its pixels are those of the "
                  "whole picture")
      ->type_name("WxH+X+Y");
  add_threads_option(verb, written);
  verb.footer(
      fmt::format("Example: barkridge render poplar.toml -o poplar.exr --size 1536x2048 --spp 16\n{}", kExitHelp));
}

void add_mesh(CLI::App& app, Written& written) {
  CLI::App& verb = *app.add_subcommand("mesh", "Makes a closed, manifold triangle mesh of the surface.");
  add_scene_options(verb, written);
  verb.add_option("-o,--output", written.output,
                  "The mesh; its extension, .ply, .obj or .stl, says the format. It appears whole or not at all")
      ->type_name("FILE")
      ->required();
  verb.add_option("--cell-size", written.cell_size,
                  "Edge length of the sampling cells in scene units (mesh.cell_size); by default 0.75 times the "
                  "thinnest branch's radius")
      ->type_name("H");
  add_threads_option(verb, written);
  verb.footer(fmt::format("Example: barkridge mesh poplar.toml -o poplar.ply --cell-size 0.01\n{}", kExitHelp));
}

void add_grow(CLI::App& app, Written& written) {
  CLI::App& verb = *app.add_subcommand("grow", "Derives an L-system and prints its string.");
  add_scene_options(verb, written, "FILE", "An L-system (.l), or a scene whose model is one");
  verb.add_option("--steps", written.steps, "Derivation steps (lsystem.steps); by default what the L-system says")
      ->type_name("N");
  verb.add_option("--seed", written.seed,
                  "Seed of the stochastic choice (lsystem.seed); by default what the L-system says")
      ->type_name("N");
  verb.footer(fmt::format("Example: barkridge grow poplar.l --steps 4\n{}", kExitHelp));
}

void add_skeleton(CLI::App& app, Written& written) {
  CLI::App& verb = *app.add_subcommand("skeleton", "Prints the skeleton as a table.");
  add_scene_options(verb, written);
  verb.footer(
      fmt::format("First line `# barkridge skeleton 1`, then an internode a line: id parent x0 y0 z0 x1 y1 z1 r0 r1,\n"
                  "parents before children, parent -1 at a root. A table in a .skel file is a scene again.\n{}",
                  kExitHelp));
}

void add_field(CLI::App& app, Written& written) {
  CLI::App& verb =
      *app.add_subcommand("field", "Prints the field and its gradient at points, by the reference evaluator.");
  add_scene_options(verb, written);
  verb.add_option("--points", written.points,
                  "Lines `x y z`, blank lines and # comments allowed; - reads the standard input")
      ->type_name("FILE")
      ->required();
  verb.footer(
      fmt::format("Prints `x y z F gx gy gz` with 17 significant digits, a line a point. The surface is where F is "
                  "0.5, the inside where it is more.\n{}",
                  kExitHelp));
}

void add_info(CLI::App& app, Written& written) {
  CLI::App& verb = *app.add_subcommand("info", "Prints what the model consists of: counts, depth, bounds, memory.");
  add_scene_options(verb, written);
  verb.add_flag("--json", written.json, "As one JSON object");
  verb.footer(kExitHelp);
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
    arguments.overrides.push_back({"lsystem.max_memory", bytes_of(written.max_memory, origin), origin});
  }
}

Verb interpret_render(const Written& written) {
  RenderArguments arguments;
  interpret_scene_options(written, arguments);
  arguments.output = written.output;
  if (!written.size.empty()) {
    const std::string origin = "--size " + written.size;
    const auto size = integers_between(written.size, "x");
    if (!size) refuse(origin, "width and height in pixels, like 768x1024");
    arguments.overrides.push_back({"image.width", fmt::format("{}", (*size)[0]), origin});
    arguments.overrides.push_back({"image.height", fmt::format("{}", (*size)[1]), origin});
  }
  add_override(arguments, "--spp", "image.samples_per_pixel", written.samples);
  add_override(arguments, "--seed", "image.seed", written.seed);
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
    interpret_scene_options(written, arguments);
    arguments.output = written.output;
    add_override(arguments, "--cell-size", "mesh.cell_size", written.cell_size);
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
  app.footer(fmt::format("`barkridge VERB --help` explains a verb.\n{}", kExitHelp));
  add_render(app, written);
  add_mesh(app, written);
  add_grow(app, written);
  add_skeleton(app, written);
  add_field(app, written);
  add_info(app, written);
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
    throw InputError("expected a verb: render, mesh, grow, skeleton, field or info\nRun `barkridge --help` for help.");
  return Command{interpret_verb(verbs.front()->get_name(), written), written.threads};
}

}  // namespace barkridge::cli
