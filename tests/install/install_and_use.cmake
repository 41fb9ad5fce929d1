# Runs a command; it must exit with STATUS. `output` gets all that it wrote.
function(run status)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out TIMEOUT 300)
  if(NOT result EQUAL status)
    message(FATAL_ERROR "${ARGN} ended with ${result}, not ${status}:\n${out}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

set(place ${BUILD}/install_test)
set(picture ${place}/picture.exr)
file(REMOVE_RECURSE ${place})

run(0 ${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/prefix)
run(0 ${CMAKE_COMMAND} -G Ninja -S ${CLIENT} -B ${place}/build -DCMAKE_PREFIX_PATH=${place}/prefix
      -DCMAKE_CXX_FLAGS=${FLAGS})
run(0 ${CMAKE_COMMAND} --build ${place}/build)
run(0 ${place}/build/client ${picture})
file(REMOVE ${picture})

# The installed tree can be moved.
file(RENAME ${place}/prefix ${place}/moved)
set(render ${place}/moved/bin/barkridge render ${place}/moved/share/barkridge/scenes/fork.toml -o ${picture})
run(0 ${render} --size 24x32 --spp 1)
file(SIZE ${picture} size)
if(size EQUAL 0)
  message(FATAL_ERROR "an empty picture")
endif()
file(REMOVE ${picture})

# Without the module a render that would take hours ends at once, and everything but EXR works.
file(GLOB_RECURSE module ${place}/moved/barkridge_images*)
file(REMOVE ${module})
run(1 ${render} --size 8192x8192 --spp 4096)
if(NOT output MATCHES "barkridge_images.*needed for this kind of image.*cannot open")
  message(FATAL_ERROR "does not tell what is missing: ${output}")
endif()
file(GLOB litter ${picture}*)
if(litter)
  message(FATAL_ERROR "left behind: ${litter}")
endif()
run(0 ${place}/moved/bin/barkridge render ${place}/moved/share/barkridge/scenes/fork.toml -o ${place}/picture.png
      --size 24x32 --spp 1)

file(REMOVE_RECURSE ${place})
