# The wrapper for VSLAM-LAB.
add_test(NAME "cli: vslamlab" COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/vslamlab_test.py $<TARGET_FILE:sslam>
         "${PROJECT_BINARY_DIR}/tests/examples/room" "${PROJECT_SOURCE_DIR}/bench/vslamlab")
set_tests_properties("cli: vslamlab" PROPERTIES FIXTURES_REQUIRED example_room SKIP_REGULAR_EXPRESSION "SKIPPED: ")
