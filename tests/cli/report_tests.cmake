# Reports in a real browser.
add_test(NAME "cli: reports in a browser" COMMAND ${CMAKE_CURRENT_LIST_DIR}/report/run
         ${CMAKE_CURRENT_LIST_DIR}/report/look.mjs $<TARGET_FILE:sslam>)
set_tests_properties("cli: reports in a browser" PROPERTIES SKIP_RETURN_CODE 77)
sslam_cli_test(NAME "report explains itself" ARGS report --help OUT "Folder that `sslam run --out` has written" "one page compares the runs")
