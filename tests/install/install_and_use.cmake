set(place ${BUILD}/install_test)
file(REMOVE_RECURSE ${place})
foreach(step
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${place}/prefix"
    "${CMAKE_COMMAND};-G;Ninja;-S;${CLIENT};-B;${place}/build;-DCMAKE_PREFIX_PATH=${place}/prefix;-DCMAKE_CXX_FLAGS=${FLAGS}"
    "${CMAKE_COMMAND};--build;${place}/build"
    "${place}/build/client"
    "${place}/prefix/bin/barkridge;--version")
  execute_process(COMMAND ${step} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${step} failed:\n${output}")
  endif()
endforeach()
file(REMOVE_RECURSE ${place})
