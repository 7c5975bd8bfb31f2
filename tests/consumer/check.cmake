# Installs the build in BINARY_DIR into a scratch prefix and builds and runs a consumer of COMPONENT against it.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()

set(prefix "${BINARY_DIR}/consumer/prefix-${COMPONENT}")
set(build "${BINARY_DIR}/consumer/build-${COMPONENT}")
file(REMOVE_RECURSE "${prefix}" "${build}")
run(${CMAKE_COMMAND} --install "${BINARY_DIR}" --prefix "${prefix}")
run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}" -B "${build}" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DCOMPONENT=${COMPONENT}" "-DCMAKE_CXX_COMPILER=${CXX}")
run(${CMAKE_COMMAND} --build "${build}")
run("${build}/consumer")
