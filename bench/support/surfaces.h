#pragma once
// The kinds of surface that the studies set against each other, by name.

#include <string>
#include <vector>

#include "blobtree/from_skeleton.h"

namespace barkridge::bench {

/// "smooth", "ridge", and "bend": ridge with bent internodes.
inline const std::vector<std::string> kSurfaces{"smooth", "ridge", "bend"};

/// Of these, and of "confined": smooth, with blending confined to internodes that meet. Throws `std::invalid_argument`
/// for other names.
TreeOptions surface_options(const std::string& surface);

}  // namespace barkridge::bench
