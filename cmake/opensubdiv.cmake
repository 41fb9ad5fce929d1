# OpenSubdiv, to compare with: only tests and benchmarks link it. Debian's package for CMake names static libraries that
# Debian does not ship, so the library is looked for itself.
find_path(OPENSUBDIV_INCLUDE_DIR opensubdiv/far/topologyRefiner.h REQUIRED)
find_library(OPENSUBDIV_LIBRARY osdCPU REQUIRED)
if(NOT TARGET opensubdiv)
  add_library(opensubdiv INTERFACE)
  target_include_directories(opensubdiv SYSTEM INTERFACE ${OPENSUBDIV_INCLUDE_DIR})
  target_link_libraries(opensubdiv INTERFACE ${OPENSUBDIV_LIBRARY})
endif()
