# `sslam batch`: what a suite with a mistake gets, before anything runs. What it does is tested in batch_test.py.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/batch)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/images ${folder}/foreign)
file(COPY_FILE ${PROJECT_SOURCE_DIR}/tests/opencv/fixtures/room.jpg ${folder}/images/0.jpg)
set(camera "%YAML:1.0\n---\nCamera.fx: 260\nCamera.fy: 260\nCamera.cx: 159.5\nCamera.cy: 119.5\n")
file(WRITE ${folder}/images/camera.yaml "${camera}")
file(WRITE ${folder}/foreign/thesis.txt "of another kind\n")
file(WRITE ${folder}/flawed.txt "1 2 3\n")
file(WRITE ${folder}/stampless.txt "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n")
set(sequence "[[sequence]]\npath = \"images\"\n")

# sslam_suite_refuses(WHAT REGEX text): exit code 1 and one line that begins with the file.
function(sslam_suite_refuses what regex text)
  string(MAKE_C_IDENTIFIER "${what}" file)
  file(WRITE ${folder}/${file}.toml "${text}")
  sslam_cli_test(NAME "batch refuses ${what}" ARGS batch ${folder}/${file}.toml --list CODE 1
                 ERR "^(sslam: note: [^\n]*\n)?sslam: error: [^\n]*${file}.toml: ${regex}[^\n]*\n$")
endfunction()
sslam_suite_refuses("an unknown key" "line 1: 'seed' is not a key of the suite. did you mean 'seeds'" "seed = 1\n${sequence}")
sslam_suite_refuses("a typo in a sequence" "line 3: 'camra' is not a key of ..sequence... did you mean 'camera'"
                    "${sequence}camra = \"camera.yaml\"\n")
sslam_suite_refuses("a word far from any key" "line 3: 'xylophone' is not a key of ..sequence... known: path, name, camera"
                    "${sequence}xylophone = 1\n")
sslam_suite_refuses("text without end" "line 2: " "[[sequence]]\npath = \"images\n")
sslam_suite_refuses("a missing path" "line 2: ..sequence..: [^\n]*nowhere: no such file or folder"
                    "[[sequence]]\npath = \"nowhere\"\n")
sslam_suite_refuses("a sequence without a path" "line 1: ..sequence.. has no path: expected a dataset"
                    "[[sequence]]\nname = \"a\"\n")
sslam_suite_refuses("no sequence" "names no sequence. expected at least one ..sequence.. with a path" "name = \"empty\"\n")
sslam_suite_refuses("one bracket" "line 1: sequence in the suite: expected a table with two brackets" "[sequence]\npath = \"images\"\n")
sslam_suite_refuses("a number for a path" "line 2: path in ..sequence..: expected text in quotes" "[[sequence]]\npath = 3\n")
sslam_suite_refuses("a missing camera" "line 2: ..sequence..: [^\n]*none.yaml: no such camera file" "${sequence}camera = \"none.yaml\"\n")
sslam_suite_refuses("a flawed ground truth" "line 2: ..sequence..: [^\n]*flawed.txt: line 1: has 3 columns"
                    "${sequence}truth = \"flawed.txt\"\n")
sslam_suite_refuses("a start after the end" "line 2: ..sequence..: [^\n]*no frame from 7 up to 1" "${sequence}start = 7\n")
sslam_suite_refuses("two of one name" "line 4: name in ..sequence..: 'images' is already used in line 2" "${sequence}${sequence}")
sslam_suite_refuses("an unknown preset" "line 4: ..method..: --preset papers: no such preset. use one of structure, paper"
                    "${sequence}[[method]]\npreset = \"papers\"\n")
sslam_suite_refuses("an unknown parameter" "line 4: ..method..: --set keyframes.min_gab: no such parameter"
                    "${sequence}[[method]]\nset = {keyframes.min_gab = 3}\n")
sslam_suite_refuses("text for a parameter" "line 4: min_gap in set: expected a number"
                    "${sequence}[[method]]\nset = {keyframes.min_gap = \"3\"}\n")
sslam_suite_refuses("unknown normals" "line 4: ..method..: --normals dpeth: not known" "${sequence}[[method]]\nnormals = \"dpeth\"\n")
sslam_suite_refuses("depth that is not there" "line 4: ..method..: --normals depth: [^\n]* has no depth images"
                    "${sequence}[[method]]\nnormals = \"depth\"\n")
sslam_suite_refuses("a negative seed" "line 1: seeds in the suite: expected a whole number from 0 on" "seeds = [1, -2]\n${sequence}")
sslam_suite_refuses("a seed twice" "line 1: seeds in the suite: 1 appears twice" "seeds = [1, 1]\n${sequence}")
sslam_suite_refuses("a share above one" "line 1: min_tracked in the suite: is out of range" "min_tracked = 50\n${sequence}")
sslam_suite_refuses("a reference to another sequence" "line 5: 'image' is not a key of trajectories of ..reference... did you mean 'images'"
                    "${sequence}[[reference]]\nname = \"ORB\"\ntrajectories = {image = \"flawed.txt\"}\n")
sslam_suite_refuses("a missing trajectory" "line 5: images in trajectories of ..reference..: [^\n]*none.txt: no such file"
                    "${sequence}[[reference]]\nname = \"ORB\"\ntrajectories = {images = \"none.txt\"}\n")
sslam_suite_refuses("a flawed trajectory" "line 3: ..reference..: [^\n]*flawed.txt: line 1: has 3 columns"
                    "${sequence}[[reference]]\nname = \"ORB\"\ntrajectories = {images = \"flawed.txt\"}\n")
sslam_suite_refuses("a trajectory without stamps" "line 3: ..reference..: [^\n]*stampless.txt: its poses have no stamps"
                    "${sequence}[[reference]]\nname = \"ORB\"\ntrajectories = {images = \"stampless.txt\"}\n")
sslam_suite_refuses("a missing earlier batch" "line 1: against: [^\n]*none: no such folder" "against = \"none\"\n${sequence}")

sslam_suite_refuses("a view wider than any" "line 3: fov in ..sequence..: --fov: [^\n]*150" "${sequence}fov = 200\n")
sslam_suite_refuses("a word for a view" "line 3: fov in ..sequence..: [^\n]*fov" "${sequence}fov = \"wide\"\n")
sslam_suite_refuses("two focal lengths" "line 2: ..sequence..: --focal excludes --fov" "${sequence}fov = 70\nfocal = 260\n")
sslam_suite_refuses("a topic of images" "line 2: ..sequence..: [^\n]*images: is no bag, so it has no topics" "${sequence}topic = \"/image\"\n")
sslam_suite_refuses("a missing mask" "line 2: ..sequence..: [^\n]*none.png" "${sequence}mask = \"none.png\"\n")
sslam_suite_refuses("two masks" "line 3: mask in ..sequence..: expected one value" "${sequence}mask = [\"a.png\", \"b.png\"]\n")
sslam_suite_refuses("a scale of no depth" "line 2: ..sequence..: --scale depth: " "${sequence}scale = \"depth\"\n")
sslam_suite_refuses("a start and starts" "line 4: starts in ..sequence..: there is a start as well" "${sequence}start = 1\nstarts = [0]\n")
sslam_suite_refuses("a start twice" "line 1: starts in the suite: 0 appears twice" "starts = [0, 0]\n${sequence}")
sslam_suite_refuses("a start behind the end" "line 2: ..sequence..: [^\n]*no frame from 7 up to 1" "${sequence}starts = [0, 7]\n")
sslam_suite_refuses("an unknown calibration" "line 4: calibration in ..method..: --calibration: 'fix' is not one of"
                    "${sequence}[[method]]\ncalibration = [\"fixed\", \"fix\"]\n")
sslam_suite_refuses("a word for a flag" "line 4: live in ..method..: expected true or false" "${sequence}[[method]]\nlive = \"yes\"\n")
sslam_suite_refuses("a flag for a number" "line 4: longest-side in ..method..: expected a value, not true or false"
                    "${sequence}[[method]]\nlongest-side = true\n")
sslam_suite_refuses("a preset that is not live" "line 3: ..method..: --live: not with --preset odometry"
                    "${sequence}[[method]]\npreset = \"odometry\"\nlive = true\n")
sslam_suite_refuses("an option with a typo" "line 4: 'longest_side' is not a key of ..method... did you mean 'longest-side'"
                    "${sequence}[[method]]\nlongest_side = 320\n")

file(WRITE ${folder}/starts.toml "starts = [0]\n${sequence}fov = 70\n[[method]]\nnormals = \"none\"\nlongest-side = [0, 320]\nno-final-pass = [false, true]\n")
sslam_cli_test(NAME "batch lists starts and options" ARGS batch ${folder}/starts.toml --list ERR "no ground truth"
               OUT "^runs/images/structure-none-longest-side=0/start-0-seed-1\nruns/images/structure-none-longest-side=0-no-final-pass/start-0-seed-1\n"
               "=320-no-final-pass/start-0-seed-1\n$")
file(WRITE ${folder}/fine.toml "${sequence}[[method]]\nnormals = [\"none\", \"onnx\"]\nset = {keyframes.min_gap = [2, 4]}\n")
sslam_cli_test(NAME "batch lists its runs" ARGS batch ${folder}/fine.toml --list ERR "no ground truth"
               OUT "^runs/images/structure-none-keyframes.min_gap=2/seed-1\nruns/images/structure-none-keyframes.min_gap=4/seed-1\n"
               "onnx-keyframes.min_gap=4/seed-1\n$")
sslam_cli_test(NAME "batch lists a shard" ARGS batch ${folder}/fine.toml --list --shard 4/4 ERR "no ground truth"
               OUT "^runs/images/structure-onnx-keyframes.min_gap=4/seed-1\n$")
sslam_cli_test(NAME "batch into a foreign folder" ARGS batch ${folder}/fine.toml --out ${folder}/foreign CODE 1
               ERR "sslam: error: [^\n]*foreign: holds files that sslam batch did not write. choose an empty folder\n$")
sslam_cli_test(NAME "batch without a suite" ARGS batch CODE 2 ERR "^sslam: error: SUITE is required")
sslam_cli_test(NAME "batch of a missing suite" ARGS batch ${folder}/none.toml CODE 1 ERR "^sslam: error: [^\n]*none.toml: cannot open")
sslam_cli_test(NAME "batch of a wrong shard" ARGS batch ${folder}/fine.toml --shard 5/4 CODE 2 ERR "--shard: '5/4' is not a part such as 2/8")
sslam_cli_test(NAME "batch of no job" ARGS batch ${folder}/fine.toml --jobs 0 CODE 2 ERR "--jobs")
sslam_cli_test(NAME "batch merge of nothing" ARGS batch merge CODE 2 ERR "^sslam: error: FOLDERS is required")
sslam_cli_test(NAME "batch merge of another folder" ARGS batch merge ${folder}/foreign CODE 1
               ERR "^sslam: error: [^\n]*foreign: holds no batch.json; expected a folder that .sslam batch. has written to\n$")
sslam_cli_test(NAME "batch explains itself" ARGS batch --help OUT "--shard" "--jobs" "merge" "Exit codes: 0 success")

foreach(case Tables Resuming Shards Failures)
  add_test(NAME "cli: batch ${case}"
           COMMAND ${CMAKE_COMMAND} -E env "SSLAM_COMMAND=$<TARGET_FILE:sslam>" python3 ${CMAKE_CURRENT_LIST_DIR}/batch_test.py ${case})
endforeach()
