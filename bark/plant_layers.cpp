#include "bark/plant_layers.h"

#include "blobtree/surface_probe.h"

namespace barkridge {

namespace {

class PlantLayers final : public SurfaceLayers {
 public:
  PlantLayers(const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives,
              const TextureMapping& mapping)
      : probe_(tree), coordinates_(tree, skeleton, primitives), mapping_(mapping) {}

  std::vector<std::string> names() const override {
    return {"deformation", "ridge", "cut", "primitive", "internode", "texture.u", "texture.v"};
  }

  void values(const Vec3& point, std::span<float> values) const override {
    thread_local SurfaceSample sample;
    probe_.at(point, sample);
    values[0] = static_cast<float>(sample.deformation);
    values[1] = static_cast<float>(sample.ridge);
    values[2] = static_cast<float>(sample.cut);
    values[3] = values[4] = -1;
    values[5] = values[6] = 0;
    const SurfaceShare* largest = largest_share(sample);
    if (!largest) return;
    const BranchFrame& frame = coordinates_.of(largest->primitive);
    const glm::dvec2 texture = texture_coordinates(mapping_, frame, branch_point(frame, largest->point));
    values[3] = static_cast<float>(largest->primitive);
    values[4] = static_cast<float>(frame.internode);
    values[5] = static_cast<float>(texture.x);
    values[6] = static_cast<float>(texture.y);
  }

 private:
  SurfaceProbe probe_;
  BranchCoordinates coordinates_;
  TextureMapping mapping_;
};

}  // namespace

std::shared_ptr<const SurfaceLayers> make_plant_layers(const BlobTree& tree, const Skeleton& skeleton,
                                                       std::span<const NodeId> primitives,
                                                       const TextureMapping& mapping) {
  return std::make_shared<PlantLayers>(tree, skeleton, primitives, mapping);
}

}  // namespace barkridge
