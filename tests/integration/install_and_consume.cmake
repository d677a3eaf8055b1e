# Installs the build, then builds and runs a project of its own against the installed tree.
# cmake -DBUILD=<build tree> -DCONSUMER=<its sources> -DWORK=<scratch> -DCXX=<compiler> -DFLAGS=<compiler flags> -P ...
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/installed")
run("${CMAKE_COMMAND}" -S "${CONSUMER}" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${WORK}/installed"
    "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/consumer")
# The flight process finds its libraries where it was installed.
run("${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH "${WORK}/installed/bin/nanomap-flight" --help)
