# OpenSubdiv, to compare with: the target `opensubdiv`, where it is installed. Debian's package for CMake names static
# libraries that Debian does not ship, so the library is looked for itself.
find_path(opensubdiv_include opensubdiv/far/topologyRefiner.h)
find_library(opensubdiv_library osdCPU)
mark_as_advanced(opensubdiv_include opensubdiv_library)
if(opensubdiv_include AND opensubdiv_library AND NOT TARGET opensubdiv)
  add_library(opensubdiv INTERFACE)
  target_include_directories(opensubdiv SYSTEM INTERFACE ${opensubdiv_include})
  target_link_libraries(opensubdiv INTERFACE ${opensubdiv_library})
endif()
