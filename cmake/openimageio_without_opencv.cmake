# Debian's OpenImageIO target names OpenCV's include directory, which its package does not bring, and CMake stops at
# generation. We do not use OpenCV: drop include directories that do not exist.
get_target_property(directories OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(existing "")
foreach(directory IN LISTS directories)
  if(EXISTS "${directory}")
    list(APPEND existing "${directory}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}")
