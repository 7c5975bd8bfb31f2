# `sslam fetch`, from a server that the test starts on this machine.
add_test(NAME "cli: fetch"
         COMMAND ${CMAKE_COMMAND} -E env "SSLAM_COMMAND=$<TARGET_FILE:sslam>" python3 ${CMAKE_CURRENT_LIST_DIR}/fetch_test.py)
sslam_cli_test(NAME "fetch lists addresses and terms" ARGS fetch --list
               OUT "lr-kt1 +https://[^\n]*living_room_traj1_frei_png.tar.gz \\(ICL-NUIM, CC BY 3.0\\)\n"
               "s-not-far +https://[^\n]*structure_notexture_far.tgz \\(TUM RGB-D, CC BY 4.0\\)\n$")
sslam_cli_test(NAME "fetch without a name" ARGS fetch CODE 2 ERR "^sslam: error: NAMES is required")
sslam_cli_test(NAME "fetch explains itself" ARGS fetch --help OUT "--mirror" "s-t-near" "Exit codes: 0 success")
