# Recordings of ROS, written and read by programs from PyPI that scripts/install_packages --tests fetches.
find_program(SSLAM_BAG_PYTHON NAMES python3 PATHS "${PROJECT_SOURCE_DIR}/build-python/bin" NO_DEFAULT_PATH)
find_program(SSLAM_BAG_PYTHON NAMES python3)
foreach(case ros1 ros2 sqlite mcap depth refusals export)
  add_test(NAME "cli: bag ${case}"
           COMMAND "${SSLAM_BAG_PYTHON}" ${CMAKE_CURRENT_LIST_DIR}/bag/bag.py $<TARGET_FILE:sslam> ${case})
  set_tests_properties("cli: bag ${case}" PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED: ")
endforeach()
