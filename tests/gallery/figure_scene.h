#pragma once

#include <memory>
#include <string>

#include "blobtree/field.h"
#include "lsystem/skeleton.h"
#include "scene/pipeline.h"

namespace barkridge::test {

/// A scene of the gallery, as the program loads it. The field is the reference one, in double precision.
struct FigureScene {
  Skeleton skeleton;  ///< empty where the tree was written by hand
  std::shared_ptr<const Field> field;
};
inline FigureScene load_figure(const std::string& name) {
  const Model model = make_model(load_scene(BARKRIDGE_SOURCE_DIR "/scenes/" + name));
  return {model.skeleton, reference_field(model.tree)};
}

}  // namespace barkridge::test
