# The tables of docs/parameters.md are those of the program.
add_test(NAME "cli: the page of parameters is up to date"
         COMMAND ${PROJECT_SOURCE_DIR}/scripts/parameter_page --check "$<TARGET_FILE:sslam>")
sslam_cli_test(NAME "a list of parameters names unit, range and meaning" ARGS run --list-parameters
               OUT "\nkeyframes.min_shared +0.5 +share +0 to 1 +of the reference keyframe")
