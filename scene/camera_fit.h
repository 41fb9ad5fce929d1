#pragma once

#include "base/geometry.h"
#include "blobtree/field.h"
#include "raytrace/render.h"
#include "scene/scene.h"

namespace barkridge {

/// The unit vector that points `azimuth` from +z towards +x and `elevation` above the horizon.
Vec3 direction_of_angles(double azimuth_degrees, double elevation_degrees);

/// The camera with everything filled in that the scene leaves to the program, so that the solid of `field` is seen
/// whole, with a margin, in a picture of this width divided by height. Without a solid it looks as at a ball of radius
/// 1 at the origin.
Camera fit_camera(const SceneCamera& camera, const Field& field, double aspect);

}  // namespace barkridge
