#include "bark/bark_shader.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace barkridge {

namespace {

// What is less than this of a surface is left out, and what is left of the others fades in from here, so that nothing
// jumps.
constexpr double kLeastShare = 0.03;
// Furrows are rough, and so is wood.
constexpr double kDullSpecular = 0.02;

class BarkShader final : public SurfaceShader {
 public:
  BarkShader(const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives,
             const Material& material, const BarkOptions& options)
      : probe_(tree), coordinates_(tree, skeleton, primitives), material_(material), options_(options) {
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
      const PatternPoint pattern = pattern_at(branch_point(frame, share.point), sample, footprint);
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
  PatternPoint pattern_at(const BranchPoint& at, const SurfaceSample& sample, double footprint) const {
    if (sample.cut >= 1) return wood_section(wood_, at, footprint);
    PatternPoint bark = bark_at(at, footprint);
    if (sample.cut > 0) {
      const PatternPoint wood = wood_section(wood_, at, footprint);
      bark.color = glm::mix(bark.color, wood.color, sample.cut);
      bark.height = mix(bark.height, wood.height, sample.cut);
    }
    return bark;
  }

  PatternPoint bark_at(const BranchPoint& at, double footprint) const {
    if (options_.kind == BarkKind::kPoplar) return poplar_bark(poplar_, at, footprint);
    return {material_.color, {}};
  }

  SurfaceProbe probe_;
  BranchCoordinates coordinates_;
  Material material_;
  BarkOptions options_;
  PoplarBark poplar_;
  Wood wood_;
};

}  // namespace

std::shared_ptr<const SurfaceShader> make_bark_shader(const BlobTree& tree, const Skeleton& skeleton,
                                                      std::span<const NodeId> primitives, const Material& material,
                                                      const BarkOptions& options) {
  if (options.kind == BarkKind::kPlain) return nullptr;
  return std::make_shared<BarkShader>(tree, skeleton, primitives, material, options);
}

}  // namespace barkridge
