# Installs the library as a package with components: find_package(sslam COMPONENTS core opencv ceres io live synth system).
# Each component has an export of its own, so that the core never looks for OpenCV or Ceres. What a developer needs is
# the install component `dev`, the command line is `cli`.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/sslam")

foreach(component core io live synth opencv ceres system)
  if(TARGET sslam_${component})
    if(component STREQUAL "system")
      install(TARGETS sslam_stages EXPORT sslam_system ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
    endif()
    install(TARGETS sslam_${component} EXPORT sslam_${component}
            ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
            FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)
    install(EXPORT sslam_${component} FILE "sslam-${component}.cmake" NAMESPACE sslam:: DESTINATION "${package_dir}"
            COMPONENT dev)
  endif()
endforeach()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/sslamConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/sslamConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/sslamConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/sslamConfig.cmake" "${PROJECT_BINARY_DIR}/sslamConfigVersion.cmake"
        DESTINATION "${package_dir}" COMPONENT dev)

# For those who build without CMake. The prefix is found from where the file lies, so the tree may be moved.
cmake_path(APPEND pc_includedir "\${prefix}" "${CMAKE_INSTALL_INCLUDEDIR}")
configure_file("${CMAKE_CURRENT_LIST_DIR}/sslam.pc.in" "${PROJECT_BINARY_DIR}/sslam.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/sslam.pc" DESTINATION "${CMAKE_INSTALL_DATADIR}/pkgconfig" COMPONENT dev)
