# `sslam view` and `sslam run --view`: what they answer on the wire, and their pages in a real browser.
foreach(case saved refusals input live interrupted)
  add_test(NAME "cli: view ${case}" COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/view/view.py $<TARGET_FILE:sslam> ${case})
endforeach()
add_test(NAME "cli: live runs and maps in a browser"
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/report/run ${CMAKE_CURRENT_LIST_DIR}/view/look.mjs $<TARGET_FILE:sslam>)
set_tests_properties("cli: live runs and maps in a browser" PROPERTIES SKIP_RETURN_CODE 77)
sslam_cli_test(NAME "view explains itself" ARGS view --help OUT "\\(map.sslam\\)" "--port INT")
