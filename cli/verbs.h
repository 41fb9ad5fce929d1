#pragma once
// What the program can be told to do. One file a verb.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/frames.h"
#include "raytrace/render.h"
#include "scene/scene.h"

namespace barkridge::cli {

/// What every verb is told.
struct SceneArguments {
  std::string path;
  std::vector<Override> overrides;
  bool quiet = false;
};

/// What verbs are told that make a picture or a mesh, or a sequence of them.
struct OutputArguments : SceneArguments {
  std::vector<std::string> outputs;
  std::optional<FrameRange> frames;
};

struct RenderArguments : OutputArguments {
  PixelRegion region;
  std::string region_origin;  ///< the region as the user wrote it
};
struct MeshArguments : OutputArguments {  // which may have no outputs if there is a file for statistics
  std::string statistics;                 ///< a file, or empty
};
struct GrowArguments : SceneArguments {};
struct SkeletonArguments : SceneArguments {};
struct FieldArguments : SceneArguments {
  std::string points;  ///< a file, or "-" for the standard input
};
struct InfoArguments : SceneArguments {
  bool json = false;
};
struct StudyArguments {
  std::vector<std::string> scenes;  ///< none for the study's own models
  std::string folder;
  std::size_t most_internodes = 200'000;
  int turns = 3;
  int places = 24;  ///< on each model where errors are measured
  int threads = 0;  ///< of each run
  bool quiet = false;
};

/// Each does its verb's work and throws whatever goes wrong.
void run(const RenderArguments& arguments);
void run(const MeshArguments& arguments);
void run(const GrowArguments& arguments);
void run(const SkeletonArguments& arguments);
void run(const FieldArguments& arguments);
void run(const InfoArguments& arguments);
void run(const StudyArguments& arguments);

using Verb = std::variant<RenderArguments, MeshArguments, GrowArguments, SkeletonArguments, FieldArguments,
                          InfoArguments, StudyArguments>;

}  // namespace barkridge::cli
