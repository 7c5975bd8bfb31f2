# What `sslam run` writes, in evo from PyPI: it gives the figures of `sslam eval`.
find_program(SSLAM_EVO_PYTHON NAMES python3 PATHS "${PROJECT_SOURCE_DIR}/build-python/bin" NO_DEFAULT_PATH)
find_program(SSLAM_EVO_PYTHON NAMES python3)
add_test(NAME "cli: evo" COMMAND "${SSLAM_EVO_PYTHON}" ${CMAKE_CURRENT_LIST_DIR}/evo_test.py $<TARGET_FILE:sslam>
         "${PROJECT_BINARY_DIR}/tests/examples/room")
set_tests_properties("cli: evo" PROPERTIES FIXTURES_REQUIRED example_room SKIP_REGULAR_EXPRESSION "SKIPPED: ")
