# Builds and runs a consumer of the build in BINARY_DIR, in the way that VIA says:
#   package        installs into a scratch prefix, where find_package finds COMPONENT
#   pkg-config     the same prefix, for a compiler without CMake
#   deb            the prefix comes out of a Debian package
#   subdirectory   the sources themselves
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()

# For the programs that Debian has and others may lack: the test says so instead of passing.
macro(need program)
  find_program(${program} ${program})
  if(NOT ${program})
    message(STATUS "SKIPPED: no ${program} here")
    return()
  endif()
endmacro()

set(scratch "${BINARY_DIR}/consumer/${VIA}-${COMPONENT}")
set(prefix "${scratch}/prefix")
set(build "${scratch}/build")
file(REMOVE_RECURSE "${scratch}")
set(source "${CMAKE_CURRENT_LIST_DIR}")
set(options "-DCOMPONENT=${COMPONENT}")

if(VIA STREQUAL "package")
  run(${CMAKE_COMMAND} --install "${BINARY_DIR}" --prefix "${prefix}")
elseif(VIA STREQUAL "pkg-config")
  need(pkg-config)
  run(${CMAKE_COMMAND} --install "${BINARY_DIR}" --prefix "${prefix}" --component dev)
  set(ENV{PKG_CONFIG_PATH} "${prefix}/share/pkgconfig")
  execute_process(COMMAND ${pkg-config} --cflags sslam OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  file(MAKE_DIRECTORY "${build}")
  run(${CXX} -std=c++20 ${flags} "${source}/geometry.cpp" -o "${build}/consumer")
  run("${build}/consumer")
  return()
elseif(VIA STREQUAL "deb")
  need(dpkg-deb)
  run(${CMAKE_CPACK_COMMAND} --config "${BINARY_DIR}/CPackConfig.cmake" -G DEB -B "${scratch}" -D CPACK_COMPONENTS_ALL=dev)
  file(GLOB package "${scratch}/libsslam-dev_*.deb")
  run(${dpkg-deb} --extract "${package}" "${scratch}/prefix")
  string(APPEND prefix "/usr")
  list(APPEND options "-DPROGRAM=geometry")
elseif(VIA STREQUAL "subdirectory")
  string(APPEND source "/subdirectory")
  list(APPEND options "-DSSLAM_SOURCE_DIR=${SOURCE_DIR}")
endif()

run(${CMAKE_COMMAND} -S "${source}" -B "${build}" ${options} "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_COMPILER=${CXX}"
    -G "${GENERATOR}")
run(${CMAKE_COMMAND} --build "${build}")
run("${build}/consumer")
