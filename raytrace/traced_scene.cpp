#include "raytrace/traced_scene.h"

#include <new>
#include <stdexcept>
#include <string>

namespace barkridge {

void TracedScene::begin() {
  for (std::size_t i = 0; i < part_count(); ++i) box_ = unite(box_, part(i));
  const double diagonal = box_.diagonal();
  center_ = box_.center();
  scale_ = diagonal > 0 ? 2 / diagonal : 1;
  device_.reset(rtcNewDevice(nullptr));
  if (!device_) throw std::runtime_error("Embree cannot start on this machine");
  embree_.reset(rtcNewScene(device_.get()));
}

void TracedScene::commit(RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree_.get());
  const RTCError error = rtcGetDeviceError(device_.get());
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

RTCRay TracedScene::unit_ray(const Ray& ray, double length) const {
  const Vec3 origin = to_unit(ray.origin);
  RTCRay unit{};
  unit.org_x = static_cast<float>(origin.x);
  unit.org_y = static_cast<float>(origin.y);
  unit.org_z = static_cast<float>(origin.z);
  unit.dir_x = static_cast<float>(ray.direction.x);
  unit.dir_y = static_cast<float>(ray.direction.y);
  unit.dir_z = static_cast<float>(ray.direction.z);
  unit.tfar = static_cast<float>(length * scale_ + 2 * kFloatMargin);
  unit.mask = ~0u;
  return unit;
}

}  // namespace barkridge
