#include "base/version.h"

namespace barkridge {

const char* version() { return BARKRIDGE_VERSION; }

}  // namespace barkridge
