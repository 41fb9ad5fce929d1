# A room of the house: one folder, one library, its headers included from the repository's root.
#   barkridge_room(NAME SOURCES a.cpp ... LINKS target ... [PRIVATE_LINKS target ...])
function(barkridge_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  set(target barkridge_${name})
  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(barkridge::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/barkridge>)
  target_link_libraries(${target} PUBLIC ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS})
  barkridge_compile_options(${target})
  install(TARGETS ${target} EXPORT barkridge ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barkridge/${name}
          FILES_MATCHING PATTERN "*.h")
endfunction()

# Equal results on every machine need equal arithmetic: no fused multiply-add that only some targets have.
function(barkridge_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic -Werror -ffp-contract=off)
endfunction()
