#include "bark/bark_shader.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace barkridge {

namespace {

// What is less than this of a surface is left out, and what is left of the others fades in from here, so that nothing
// jumps.
constexpr double kLeastShare = 0.03;
// Furrows are rough, and so is wood.
constexpr double kDullSpecular = 0.02;
// The white of an image stands out over its black by this share of the image's width.
constexpr double kImageHeight = 0.02;
// Of an image's width or height.
constexpr double kLeastImageStep = 1.0 / 2048;

class BarkShader final : public SurfaceShader {
 public:
  BarkShader(const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives,
             const Material& material, const BarkOptions& options, const ImageBark& image)
      : probe_(tree), coordinates_(tree, skeleton, primitives), material_(material), options_(options), image_(image) {
    const double thickest = coordinates_.thickest() > 0 ? coordinates_.thickest() : 1;
    poplar_.scale = options.scale.value_or(0.2 * thickest);
    poplar_.furrowed_radius = options.furrowed_radius.value_or(0.5 * thickest);
    poplar_.smooth_color = options.smooth_color;
    poplar_.furrowed_color = options.furrowed_color;
    wood_.color = options.wood_color;
    wood_.ring_width = options.ring_width.value_or(0.025 * thickest);
  }

  ShadedPoint shade(const Vec3& point, const Vec3& normal, double footprint) const override {
    thread_local SurfaceSample sample;
    probe_.at(point, sample);
    ShadedPoint shaded{material_, normal};
    if (sample.shares.empty()) return shaded;

    // The hit is on the surface to the tracer's tolerance only, where a share may be missing.
    Color color(0);
    Vec3 slope(0);
    double total = 0;
    for (const SurfaceShare& share : sample.shares) total += std::max(0.0, share.weight - kLeastShare);
    for (const SurfaceShare& share : sample.shares) {
      const double weight = total > 0 ? std::max(0.0, share.weight - kLeastShare) / total : share.weight;
      if (weight == 0) continue;
      const BranchFrame& frame = coordinates_.of(share.primitive);
      const PatternPoint pattern = pattern_at(frame, branch_point(frame, share.point), sample, footprint);
      color += weight * pattern.color;
      slope += weight * (pattern.height.slope * glm::transpose(frame.axes) * share.jacobian);
    }
    const double ridge = options_.ridge * sample.ridge * (1 - sample.cut);
    shaded.material.color = glm::mix(color, options_.ridge_color, ridge);
    if (sample.cut > 0.5) shaded.material.specular = std::min(material_.specular, kDullSpecular);
    const Vec3 bumped = normal - options_.bump * (slope - glm::dot(slope, normal) * normal);
    shaded.normal = glm::normalize(bumped);
    return shaded;
  }

 private:
  PatternPoint pattern_at(const BranchFrame& frame, const BranchPoint& at, const SurfaceSample& sample,
                          double footprint) const {
    if (sample.cut >= 1) return wood_section(wood_, at, footprint);
    PatternPoint bark = bark_at(frame, at, footprint);
    if (sample.cut > 0) {
      const PatternPoint wood = wood_section(wood_, at, footprint);
      bark.color = glm::mix(bark.color, wood.color, sample.cut);
      bark.height = mix(bark.height, wood.height, sample.cut);
    }
    return bark;
  }

  PatternPoint bark_at(const BranchFrame& frame, const BranchPoint& at, double footprint) const {
    if (options_.kind == BarkKind::kPoplar) return poplar_bark(poplar_, at, footprint);
    if (options_.kind == BarkKind::kImage) return image_at(frame, at, footprint);
    return {material_.color, {}};
  }

  // The image's colour; its brightness as height, whose slope comes from differences over the footprint.
  PatternPoint image_at(const BranchFrame& frame, const BranchPoint& at, double footprint) const {
    const double circumference =
        2 * std::numbers::pi * std::max(1e-6 * at.radius, std::hypot(at.position.x, at.position.z));
    const glm::dvec2 place = texture_coordinates(image_.mapping, frame, at);
    // What one image is wide and high here.
    const glm::dvec2 size(
        circumference / texture_repeats(image_.mapping, frame),
        image_.mapping.followed_radius > 0
            ? image_.mapping.height * circumference / (image_.mapping.width * texture_repeats(image_.mapping, frame))
            : image_.mapping.height);
    const glm::dvec2 wide = footprint / size, step = glm::max(wide, glm::dvec2(kLeastImageStep));
    const auto brightness = [](const Color& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
    PatternPoint result;
    result.color = image_.texture->color(place, wide);
    if (options_.bump == 0) return result;
    const double height = kImageHeight * size.x, here = brightness(result.color);
    const double by_u = (brightness(image_.texture->color(place + glm::dvec2(step.x, 0), wide)) - here) / step.x;
    const double by_v = (brightness(image_.texture->color(place + glm::dvec2(0, step.y), wide)) - here) / step.y;
    const Vec3 around(std::cos(at.around), 0, -std::sin(at.around));
    result.height = {height * here, height * (by_u / size.x * around + Vec3(0, by_v / size.y, 0))};
    return result;
  }

  SurfaceProbe probe_;
  BranchCoordinates coordinates_;
  Material material_;
  BarkOptions options_;
  ImageBark image_;
  PoplarBark poplar_;
  Wood wood_;
};

}  // namespace

std::shared_ptr<const SurfaceShader> make_bark_shader(const BlobTree& tree, const Skeleton& skeleton,
                                                      std::span<const NodeId> primitives, const Material& material,
                                                      const BarkOptions& options, const ImageBark& image) {
  if (options.kind == BarkKind::kPlain) return nullptr;
  return std::make_shared<BarkShader>(tree, skeleton, primitives, material, options, image);
}

}  // namespace barkridge
