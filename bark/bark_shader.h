#pragma once
// The look of a plant's surface: what its primitives show, mixed by their shares.

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "bark/branch_coordinates.h"
#include "bark/poplar_bark.h"
#include "bark/texture_mapping.h"
#include "bark/wood.h"
#include "blobtree/surface_probe.h"
#include "raytrace/image_texture.h"
#include "raytrace/surface_shader.h"

namespace barkridge {

enum class BarkKind {
  kPlain,   ///< one material everywhere, also on ridges and cuts: no shader
  kEven,    ///< one colour, but for ridges and cuts
  kPoplar,  ///< [bark/poplar_bark.h]
  kImage,   ///< an image's colours, and its brightness as height
};

struct BarkOptions {
  BarkKind kind = BarkKind::kPlain;
  /// Width of the pattern's features; without it a fifth of the thickest branch's radius.
  std::optional<double> scale;
  /// Radius where bark is half furrowed; without it half the thickest branch's.
  std::optional<double> furrowed_radius;
  std::string image;  ///< path of the image
  double bump = 1;    ///< factor of the pattern's height, >= 0
  Color smooth_color = PoplarBark{}.smooth_color;
  Color furrowed_color = PoplarBark{}.furrowed_color;
  Color ridge_color{0.03, 0.025, 0.02};
  double ridge = 0.8;  ///< how much of that colour ridges have, 0 to 1
  Color wood_color = Wood{}.color;
  /// Without it a fortieth of the thickest branch's radius.
  std::optional<double> ring_width;
};

/// The image of image bark, opened, and where it lies.
struct ImageBark {
  std::shared_ptr<const ImageTexture> texture;
  TextureMapping mapping;
};

/// A shader of the tree's surface; null for plain bark. `material` gives the gloss, and the colour of even bark.
/// `primitives` are the nodes of the skeleton's internodes, both empty for a tree written by hand. Bumps turn the
/// normal as if the surface stood out by the mix of its patterns' heights, with the shares held still. Keeps no
/// reference. Cost: as `compile`; of an answer some microseconds.
std::shared_ptr<const SurfaceShader> make_bark_shader(const BlobTree& tree, const Skeleton& skeleton,
                                                      std::span<const NodeId> primitives, const Material& material,
                                                      const BarkOptions& options, const ImageBark& image = {});

}  // namespace barkridge
