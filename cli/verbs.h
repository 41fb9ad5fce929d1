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
struct MeshArguments : OutputArguments {};
struct GrowArguments : SceneArguments {};
struct SkeletonArguments : SceneArguments {};
struct FieldArguments : SceneArguments {
  std::string points;  ///< a file, or "-" for the standard input
};
struct InfoArguments : SceneArguments {
  bool json = false;
};

/// Each does its verb's work and throws whatever goes wrong.
void run(const RenderArguments& arguments);
void run(const MeshArguments& arguments);
void run(const GrowArguments& arguments);
void run(const SkeletonArguments& arguments);
void run(const FieldArguments& arguments);
void run(const InfoArguments& arguments);

using Verb =
    std::variant<RenderArguments, MeshArguments, GrowArguments, SkeletonArguments, FieldArguments, InfoArguments>;

}  // namespace barkridge::cli
