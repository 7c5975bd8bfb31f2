# `cpack -G DEB` in the build folder makes two packages: libsslam-dev (the headers) and sslam (the command line and its
# network).
set(CPACK_PACKAGE_NAME sslam)
set(CPACK_PACKAGE_CONTACT "the sslam authors")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL dev)

set(CPACK_COMPONENT_DEV_DESCRIPTION "${PROJECT_DESCRIPTION}: the library: headers of C++20, and the compiled system")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libsslam-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libopencv-dev, libopencv-contrib-dev, libceres-dev")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSES/copyright" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libsslam-dev"
        COMPONENT dev)

if(SSLAM_BUILD_CLI)
  list(APPEND CPACK_COMPONENTS_ALL cli)
  set(CPACK_COMPONENT_CLI_DESCRIPTION "${PROJECT_DESCRIPTION}: the command line")
  set(CPACK_DEBIAN_CLI_PACKAGE_NAME sslam)
  set(CPACK_DEBIAN_CLI_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_CLI_PACKAGE_SHLIBDEPS ON)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSES/copyright" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/sslam"
          COMPONENT cli)
endif()
include(CPack)
