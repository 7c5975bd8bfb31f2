# The man page and the completions: whether they know each option, work, and get where they belong.
foreach(what options man bash zsh install)
  add_test(NAME "cli: self description ${what}"
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/self_description.py $<TARGET_FILE:sslam> ${PROJECT_BINARY_DIR} ${what})
  set_tests_properties("cli: self description ${what}" PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
set_tests_properties("cli: self description install" PROPERTIES RESOURCE_LOCK install)
sslam_cli_test(NAME "completion for an unknown shell" ARGS --completion fish CODE 2
               ERR "^sslam: error: --completion: fish not in {bash,zsh}")

# What it is made of, and by which terms.
add_test(NAME "cli: bill of materials"
         COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/sbom_test.py ${PROJECT_SOURCE_DIR}/scripts/sbom ${PROJECT_BINARY_DIR})
set_tests_properties("cli: bill of materials" PROPERTIES SKIP_RETURN_CODE 77)
