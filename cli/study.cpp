#include "study/study.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/progress_bar.h"
#include "cli/verbs.h"
#include "study/machine.h"
#include "study/models.h"
#include "study/scaling.h"

extern char** environ;

namespace barkridge::cli {

namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw IoError(path.string(), error.message());
}

void write_file(const fs::path& path, const std::string& text) {
  OutputFile file(path.string());
  file.write(text);
  file.commit();
}

// Runs this same program, and waits for it. What it complains of has been seen on the standard error.
void run_self(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  const int failure = ::posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, argv.data(), environ);
  if (failure != 0) throw std::runtime_error(fmt::format("cannot start a run: {}", std::strerror(failure)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error(fmt::format("cannot wait for a run: {}", std::strerror(errno)));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("a run failed: " + fmt::format("{}", fmt::join(arguments, " ")));
  }
}

MeshRunner runner_in(const fs::path& folder, int threads) {
  return [statistics = (folder / "run.json").string(), threads](const std::string& scene,
                                                                const std::vector<std::string>& definitions) {
    std::vector<std::string> arguments{"barkridge",    "mesh",     scene,       "-q",
                                       "--statistics", statistics, "--threads", fmt::format("{}", threads)};
    for (const std::string& definition : definitions) arguments.insert(arguments.end(), {"-D", definition});
    run_self(arguments);
    const auto values = nlohmann::json::parse(read_file(statistics));
    fs::remove(statistics);
    return RunCosts{values.at("internodes"),     values.at("crossing_limbs"),   values.at("triangles"),
                    values.at("peak_bytes"),     values.at("skeleton_seconds"), values.at("build_seconds"),
                    values.at("surface_seconds")};
  };
}

// The study's own models as files, so that anyone can look at them and run them again.
std::vector<StudyScene> own_scenes(const fs::path& folder, std::size_t most_internodes) {
  make_folder(folder);
  std::vector<StudyScene> scenes;
  for (const StudyModel& model : study_models(most_internodes)) {
    const fs::path path = folder / (model.name + ".l");
    write_file(path, model.lsystem);
    scenes.push_back({model.name, path.string(), model.meaning});
  }
  return scenes;
}

std::vector<StudyScene> given_scenes(const std::vector<std::string>& paths) {
  std::vector<StudyScene> scenes;
  for (const std::string& path : paths) scenes.push_back({fs::path(path).stem().string(), path, path});
  return scenes;
}

ReportSection scaling_section(int turns) {
  ReportSection section{"How the parts grow", {}, {}, {}, {}};
  section.plots = {{"Time of one joint against its branches", "branches", "seconds", joint_times(turns)},
                   {"Time of one Loop step against its triangles", "triangles before", "seconds", {loop_times(turns)}}};
  for (const Plot& plot : section.plots) {
    ReportTable table{plot.series.size() > 1 ? "joints" : "loop", plot.title, {"method", plot.x_label, "seconds"}, {}};
    for (const PlotSeries& series : plot.series) {
      for (const glm::dvec2& p : series.points) table.rows.push_back({series.name, p.x, p.y});
    }
    section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace

void run(const StudyArguments& arguments) {
  const fs::path folder(arguments.folder);
  make_folder(folder / "pictures");
  const std::vector<StudyScene> scenes = arguments.scenes.empty()
                                             ? own_scenes(folder / "models", arguments.most_internodes)
                                             : given_scenes(arguments.scenes);
  StudyOptions options;
  options.turns = arguments.turns;
  options.windows = arguments.places;
  options.picture_folder = (folder / "pictures").string();
  ProgressBar bar(arguments.quiet);
  options.progress = bar.stage("studying");
  const StudyFindings findings = measure(scenes, runner_in(folder, arguments.threads), options);
  Report report = report_of(findings, scenes, machine_facts());
  report.sections.push_back(scaling_section(arguments.turns));

  write_file(folder / "report.html", html(report));
  write_file(folder / "report.json", json(report).dump(2) + '\n');
  for (const ReportSection& section : report.sections) {
    for (const ReportTable& table : section.tables) write_file(folder / (table.name + ".csv"), csv(table));
  }
}

}  // namespace barkridge::cli
