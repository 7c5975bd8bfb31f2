# The command line as people type it: words that nobody knows, options before and behind arguments, help.
foreach(options "--set;keyframes.max_turn=10" "-o;somewhere" "-v")
  sslam_cli_test(NAME "run takes ${options} in front of its dataset" ARGS run ${options} nowhere CODE 1
                 ERR "^sslam: error: nowhere: no such file or folder\n$")
endforeach()
sslam_cli_test(NAME "batch takes --against in front of its suite" ARGS batch --against earlier nowhere.toml CODE 1 ERR "nowhere.toml: ")
# sslam_unknown_word(WORDS MESSAGE): exit code 2 and one line.
function(sslam_unknown_word message)
  string(JOIN " " typed ${ARGN})
  sslam_cli_test(NAME "there is no sslam ${typed}" ARGS ${ARGN} CODE 2 ERR "^sslam: error: ${message} \\(see sslam --help\\)\n$")
endfunction()
sslam_unknown_word("'rnu' is not a command. did you mean 'run'\\?" rnu)
sslam_unknown_word("'rnu' is not a command. did you mean 'run'\\?" rnu room --live)
sslam_unknown_word("'rnu' is not a command. did you mean 'run'\\?" help rnu)
sslam_unknown_word("'velvet' is not a command. known: run, eval, [^\n]*" velvet)
sslam_unknown_word("'--vresion' is not an option of sslam. did you mean '--version'\\?" --vresion)
sslam_unknown_word("'--pre-set' is not an option of sslam run. did you mean '--preset'\\?" run --pre-set paper room)
sslam_unknown_word("'--pre-set' is not an option of sslam run. did you mean '--preset'\\?" run --pre-set=paper)
sslam_unknown_word("'--velvet-curtain' is not an option of sslam run" run room --velvet-curtain)
sslam_unknown_word("'rooms' is one word too many for sslam run" run room rooms)
sslam_unknown_word("'--aganst' is not an option of sslam merge. did you mean '--against'\\?" batch merge a b --aganst c)
sslam_cli_test(NAME "help of a command" ARGS help run OUT "\nInput:\n" "\nTracking:\n" "\nOutput:\n" "Examples:\n  sslam run " "-o,--out DIR")
sslam_cli_test(NAME "help of everything" ARGS help OUT "Subcommands:\n +run +Track a sequence" "sslam help run")
sslam_cli_test(NAME "a number below an endless range" ARGS run room --fps 0 CODE 2
               ERR "^sslam: error: --fps: Value 0 is out of range; expected a positive number .see sslam --help.\n$")
# Numbers that a range lets through: nan is not outside of any.
foreach(options "--fps;nan" "--focal;nan" "--fov;-nan" "--retry;nan" "--read-out;nan" "--checkpoint;nan" "--fps;inf")
  string(JOIN " " typed ${options})
  sslam_cli_test(NAME "no number for run ${typed}" ARGS run room ${options} CODE 2 ERR "^sslam: error: --[a-z-]+: '[-a-z]+' is not a number .see sslam --help.\n$")
endforeach()
sslam_cli_test(NAME "no number for eval --offset" ARGS eval a b --offset nan CODE 2 ERR "^sslam: error: --offset: 'nan' is not a number")
sslam_cli_test(NAME "a seed below 0" ARGS run room --seed -1 CODE 2 ERR "^sslam: error: --seed: '-1' is not a whole number from 0 on")
# A parameter that no stage has, in a file: bad input, and told with the file. On the command line it is a wrong one.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/parameters.toml "end = 2\n[set]\nkeyframes.max_turm = 9\n")
sslam_cli_test(NAME "an unknown parameter in a file of options" ARGS run nowhere --config ${CMAKE_CURRENT_BINARY_DIR}/parameters.toml CODE 1
               ERR "^sslam: error: [^\n]*parameters.toml: line 3: .set. [^\n]*keyframes.max_turm[^\n]*keyframes.max_turn[^\n]*\n$")
# Options in a file as Windows' editors write it.
string(ASCII 239 187 191 mark)
string(ASCII 13 10 line_end)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/windows.toml "${mark}end = 2${line_end}normals = \"none\"${line_end}")
sslam_cli_test(NAME "options in a file with a byte order mark" ARGS run nowhere --config ${CMAKE_CURRENT_BINARY_DIR}/windows.toml CODE 1
               ERR "^sslam: error: nowhere: no such file or folder\n$")
