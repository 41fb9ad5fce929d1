#include "blobtree/from_skeleton.h"
#include "mesh/topology.h"
#include "polygonize/polygonize.h"
#include "raytrace/image_file.h"
#include "scene/pipeline.h"

int main(int, char** argv) {
  barkridge::write_image({2, 2, {0, 0, 2, 2}, std::vector<float>(16, 1)}, argv[1]);
  barkridge::Skeleton skeleton;
  skeleton.internodes.push_back({barkridge::Vec3(0), barkridge::Vec3(0, 1, 0), 0.2, 0.2});
  barkridge::PolygonizeOptions options;
  options.cell_size = 0.05;
  const auto field = barkridge::compile(barkridge::tree_from_skeleton(skeleton));
  return barkridge::examine(barkridge::polygonize(*field, options)).closed_manifold() ? 0 : 1;
}
