#include "raytrace/image_module.h"

#include <dlfcn.h>

#include <string>

#include "base/error.h"

namespace barkridge {

void* image_module_function(const char* name) {
  void* const module = ::dlopen(BARKRIDGE_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* const function = module == nullptr ? nullptr : ::dlsym(module, name);
  if (function == nullptr) {
    throw IoError(BARKRIDGE_IMAGE_MODULE,
                  std::string("is needed for this kind of image and cannot be loaded: ") + ::dlerror());
  }
  return function;
}

}  // namespace barkridge
