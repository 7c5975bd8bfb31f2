# Progress: options that do not go together. What is told is tested in progress_test.cpp.
foreach(command run synth)
  sslam_cli_test(NAME "${command} refuses to be quiet and verbose" ARGS ${command} nowhere --quiet --verbose CODE 2 ERR "^sslam: error: ")
endforeach()
sslam_cli_test(NAME "progress options are explained" ARGS run --help OUT "--quiet" "--json-progress" "--verbose")
