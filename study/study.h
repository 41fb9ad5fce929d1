#pragma once
// The comparison of the implicit and the subdivision path, as the thesis made it [MacM04, chapter 8], on this machine.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "study/measurement.h"
#include "study/report.h"

namespace barkridge {

/// A scene to compare on, and what it is called.
struct StudyScene {
  std::string name, path, meaning;
};

/// A way to dress a model at one resolution. `cell_factor` counts for the implicit method: the sampling cells' width in
/// the thinnest branch's radii; `level` for the others.
struct StudySetting {
  std::string method;  ///< as `surface.method` has it
  double cell_factor = 0;
  int level = 0;

  std::string name() const;
};

/// What one run in a process of its own took; see `mesh --statistics`.
struct RunCosts {
  std::size_t internodes = 0, crossing_limbs = 0, triangles = 0, peak_bytes = 0;
  double skeleton = 0, build = 0, surface = 0;
};

/// Makes a scene's mesh in a process of its own, with these values for keys of the scene, and says what it took. Throws
/// whatever prevents it.
using MeshRunner = std::function<RunCosts(const std::string& scene, const std::vector<std::string>& definitions)>;

struct StudyOptions {
  /// Times that every setting is run, in turn with all others of its model.
  int turns = 3;
  /// Settings that are expected to have more are left out, and the report says so.
  std::size_t max_triangles = 20'000'000;
  /// Places on each model where its error is measured.
  int windows = 24;
  /// Crossings are counted in meshes of at most so many triangles.
  std::size_t most_for_crossings = 1'000'000;
  /// Width and height of the pictures that are shown, in pixels, and the folder that they are put into.
  int picture = 420;
  std::string picture_folder;
  Progress progress;
};

/// Width of the pictures that errors are counted in: the model's largest extent has as many pixels.
inline constexpr double kErrorPixels = 1024;

struct StudyFindings {
  std::vector<Measurement> measurements;
  std::vector<ReportPicture> pictures;
  std::vector<std::string> notes;  ///< what was left out, and why
};

/// Measures every method at several resolutions on every scene. Throws what reading and making the models throws, and
/// `Cancelled`.
StudyFindings measure(const std::vector<StudyScene>& scenes, const MeshRunner& run, const StudyOptions& options);

/// The report of it, with the thesis' figures beside ours.
Report report_of(const StudyFindings& findings, const std::vector<StudyScene>& scenes,
                 const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace barkridge
