#pragma once
// The program as ten calls, in this order:
//
//     load_scene -> grow -> draw or make_skeleton -> make_tree or make_model -> compile (blobtree/tree.h)
//         -> make_render_scene, render -> write_picture
//         -> implicit_mesh, or make_control_mesh, refine (scene/surface.h) -> render or write_surface

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "base/geometry.h"
#include "base/progress.h"
#include "blobtree/tree.h"
#include "lsystem/grammar.h"
#include "lsystem/notify.h"
#include "lsystem/skeleton.h"
#include "lsystem/word.h"
#include "mesh/mesh.h"
#include "raytrace/render.h"
#include "scene/scene.h"

namespace barkridge {

/// Who hears of a model's making: how far it is, and what is odd about it.
struct Listener {
  Progress progress;
  Notify notify;
};

/// Whether the scene's model comes from an L-system, from a string of modules (an L-system's or a given one), from a
/// skeleton (a string's or a given one).
bool has_lsystem(const Scene& scene);
bool has_word(const Scene& scene);
bool has_skeleton(const Scene& scene);

/// The scene at a time of its growth, or, without a time, grown up. Throws `InputError` for a time if the model is no
/// L-system's, `LimitError` for one after `kMaxGrowthTime`.
Scene at_time(const Scene& scene, std::optional<double> time);

/// A string of modules, and the L-system that it came from, if any.
struct Growth {
  std::optional<Grammar> grammar;
  Word word;
};

/// Derives the scene's L-system, or reads its string. Throws `InputError` if it has neither or they are wrong,
/// `LimitError`.
Growth grow(const Scene& scene, const Listener& listener = {});

/// The skeleton that the turtle draws.
Skeleton draw(const Scene& scene, const Growth& growth, const Listener& listener = {});

/// The scene's skeleton, from whatever source: read, or grown and drawn; as thick as `growth` makes it. Throws
/// `InputError` if a tree is its model.
Skeleton make_skeleton(const Scene& scene, const Listener& listener = {});

/// A model ready for compilation. The skeleton is without what the scene cuts and sheds, and empty where the tree was
/// written by hand.
struct Model {
  Skeleton skeleton;
  BlobTree tree;
  std::vector<NodeId> primitives = {};  ///< the nodes of the skeleton's internodes
};
Model make_model(const Scene& scene, const Listener& listener = {});
Model make_model(const Scene& scene, Skeleton skeleton);

/// The smallest radius of an internode or, in trees written by hand, of a primitive, scaled as its warps scale it at
/// the most; 0 for an empty model.
double thinnest_radius(const Model& model);

/// The scene's cell size, or half the thinnest radius; half a grown tip's where the pipe model makes radii; in either
/// case at most a quarter of the finest wavelength of displacements. Throws
/// `InputError` for a model without one that is empty, or growing by drawn widths, whose radii begin at 0.
double cell_size(const Scene& scene, const Model& model);

/// The solid that camera and ground are fitted to: `field`, the model's own, or at a time of its growth the model's at
/// `growth.framed_time`, so that all frames have one view.
std::shared_ptr<const Field> framed_field(const Scene& scene, std::shared_ptr<const Field> field,
                                          const Listener& listener = {});

/// The mesh with what the scene's `mesh.attributes` asks for; the mesh itself where it does not.
Mesh make_dressed(Mesh mesh, const Scene& scene, const Model& model);

/// The look of the scene, with everything filled in that it leaves to the program: the camera for the solid of `field`,
/// which need not be the one that is rendered, the bark for the model that is.
RenderScene make_render_scene(const Scene& scene, const Model& model, const Field& field);

/// The file's header names the version, the scene's hash and all that determines the pixels.
void write_picture(const Image& image, const Scene& scene, const Model& model, const std::string& path);
void write_surface(const Mesh& mesh, const Scene& scene, const Model& model, const std::string& path);

}  // namespace barkridge
