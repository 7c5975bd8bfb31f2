# `sslam run --foxglove`: read by Foxglove's own client from npm, which scripts/install_packages --tests fetches, and asked in bytes.
find_program(SSLAM_BAG_PYTHON NAMES python3 PATHS "${PROJECT_SOURCE_DIR}/build-python/bin" NO_DEFAULT_PATH)
find_program(SSLAM_BAG_PYTHON NAMES python3)
foreach(case stream refusals limits interrupted)
  add_test(NAME "cli: foxglove ${case}" COMMAND "${SSLAM_BAG_PYTHON}" ${CMAKE_CURRENT_LIST_DIR}/foxglove/foxglove.py $<TARGET_FILE:sslam>
                                                "${PROJECT_SOURCE_DIR}/build-npm" ${case})
  set_tests_properties("cli: foxglove ${case}" PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED: ")
endforeach()
