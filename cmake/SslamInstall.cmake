# Installs the library as a package with components: find_package(sslam COMPONENTS core opencv ceres io).
# Each component has an export of its own, so that the core never looks for OpenCV or Ceres.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sslam")

foreach(component core io opencv ceres)
  if(TARGET sslam_${component})
    install(TARGETS sslam_${component} EXPORT sslam_${component} FILE_SET HEADERS
            DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT sslam_${component} FILE "sslam-${component}.cmake" NAMESPACE sslam:: DESTINATION "${package_dir}")
  endif()
endforeach()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/sslamConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/sslamConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/sslamConfigVersion.cmake" COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/sslamConfig.cmake" "${PROJECT_BINARY_DIR}/sslamConfigVersion.cmake"
        DESTINATION "${package_dir}")
