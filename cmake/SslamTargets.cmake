# Helpers that give every sslam target the same shape.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)

# sslam_add_interface(NAME FLOORS folder... LINKS target...): a header-only target sslam::NAME, with the umbrella header
# sslam/NAME.hpp where there is one.
function(sslam_add_interface name)
  cmake_parse_arguments(ARG "" "" "FLOORS;LINKS" ${ARGN})
  add_library(sslam_${name} INTERFACE)
  add_library(sslam::${name} ALIAS sslam_${name})
  set_target_properties(sslam_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(sslam_${name} INTERFACE cxx_std_20)
  target_link_libraries(sslam_${name} INTERFACE ${ARG_LINKS})
  set(headers)
  foreach(floor IN LISTS ARG_FLOORS)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/sslam/${floor}/*.hpp")
    list(APPEND headers ${found})
  endforeach()
  if(EXISTS "${PROJECT_SOURCE_DIR}/include/sslam/${name}.hpp")
    list(APPEND headers "${PROJECT_SOURCE_DIR}/include/sslam/${name}.hpp")
  endif()
  if(headers)
    target_sources(sslam_${name} INTERFACE FILE_SET HEADERS
                   BASE_DIRS "${PROJECT_SOURCE_DIR}/include" FILES ${headers})
  else()
    target_include_directories(sslam_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
  endif()
endfunction()

# Warnings and sanitizers: for targets that we compile, never for those who link sslam.
function(sslam_own_target target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${SSLAM_WERROR}>:-Werror>)
  # g++ 12 sees overlapping copies in harmless string concatenations (GCC bug 105651).
  target_compile_options(${target} PRIVATE $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
  if(SSLAM_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${SSLAM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${SSLAM_SANITIZE})
  endif()
endfunction()

# What makes a fault in reading a hostile file end the program instead of obeying the file: for the program that people
# run, never for the library. Checked copies, a guarded stack, and tables of addresses that are read-only once it runs.
function(sslam_harden target)
  if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
    return()
  endif()
  target_compile_options(${target} PRIVATE -fstack-protector-strong)
  if(NOT SSLAM_SANITIZE)  # which checks more, and does not go with the other
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-U_FORTIFY_SOURCE$<SEMICOLON>-D_FORTIFY_SOURCE=2>)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    target_link_options(${target} PRIVATE -Wl,-z,relro,-z,now)
  endif()
endfunction()
