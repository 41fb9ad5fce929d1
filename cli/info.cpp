#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "cli/progress_bar.h"
#include "cli/results.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "cli/work_statistics.h"
#include "scene/model_statistics.h"
#include "scene/pipeline.h"
#include "scene/scene_hash.h"
#include "scene/solid_bounds.h"

namespace barkridge::cli {

namespace {

struct Info {
  std::string hash;
  std::optional<std::size_t> modules;
  ModelStatistics model;
  Box bounds;
  double thinnest_radius = 0;
  std::size_t resident_bytes = 0, peak_bytes = 0;
};

std::size_t resident_bytes() {
  std::size_t total_pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> total_pages >> resident_pages;
  return resident_pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

Info collect(const InfoArguments& arguments) {
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  ProgressBar bar(arguments.quiet);
  Info info;
  Model model;
  if (has_word(scene)) {
    const Listener listener{bar.stage("growing"), warn};
    const Growth growth = grow(scene, listener);
    info.modules = growth.word.modules.size();
    model = make_model(scene, draw(scene, growth, listener));
  } else {
    model = make_model(scene);
  }
  info.hash = scene_hash(scene, model);
  info.model = statistics(model);
  info.bounds = solid_bounds(*compile(model.tree));
  info.thinnest_radius = thinnest_radius(model);
  info.resident_bytes = resident_bytes();
  info.peak_bytes = peak_resident_bytes();
  return info;
}

std::string json_text(const Info& info) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["version"] = version();
  json["scene_hash"] = info.hash;
  json["modules"] = info.modules ? Json(*info.modules) : Json(nullptr);
  json["internodes"] = info.model.internodes;
  json["organs"] = info.model.organs;
  json["dropped_internodes"] = info.model.dropped_internodes;
  json["junctions"] = info.model.junctions;
  json["primitives"] = info.model.primitives;
  json["tree_nodes"] = info.model.tree_nodes;
  json["tree_depth"] = info.model.tree_depth;
  json["bounds"] = nullptr;
  if (!info.bounds.empty()) {
    json["bounds"] = {{"lo", {info.bounds.lo.x, info.bounds.lo.y, info.bounds.lo.z}},
                      {"hi", {info.bounds.hi.x, info.bounds.hi.y, info.bounds.hi.z}}};
  }
  json["thinnest_radius"] = info.thinnest_radius;
  json["memory"] = {{"model_bytes", info.model.bytes},
                    {"resident_bytes", info.resident_bytes},
                    {"peak_resident_bytes", info.peak_bytes}};
  return json.dump(2) + '\n';
}

std::string text_of(const Vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }
std::string megabytes(std::size_t bytes) { return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6); }

std::string plain_text(const Info& info) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) { text += fmt::format("{:<20}{}\n", name, value); };
  const auto count = [&](const char* name, std::size_t value) { line(name, fmt::format("{}", value)); };
  line("scene hash", info.hash);
  if (info.modules) count("modules", *info.modules);
  count("internodes", info.model.internodes);
  count("organs", info.model.organs);
  count("dropped internodes", info.model.dropped_internodes);
  count("junctions", info.model.junctions);
  count("primitives", info.model.primitives);
  count("tree nodes", info.model.tree_nodes);
  count("tree depth", info.model.tree_depth);
  line("bounds", info.bounds.empty() ? "empty" : text_of(info.bounds.lo) + " to " + text_of(info.bounds.hi));
  line("thinnest radius", fmt::format("{:.6g}", info.thinnest_radius));
  line("model memory", megabytes(info.model.bytes));
  line("resident memory", megabytes(info.resident_bytes));
  line("peak memory", megabytes(info.peak_bytes));
  return text;
}

}  // namespace

void run(const InfoArguments& arguments) {
  const Info info = collect(arguments);
  write_results(arguments.json ? json_text(info) : plain_text(info));
}

}  // namespace barkridge::cli
