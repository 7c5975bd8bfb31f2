# Trajectories for `sslam eval`, small enough to work out by hand: an L of 1 m steps, one pose a second.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/eval)
file(MAKE_DIRECTORY ${folder})
set(truth "# stamp tx ty tz qx qy qz qw\n")
set(doubled "")
set(late "")
set(matrices "")
set(upside_down "")
foreach(i RANGE 0 9)
  if(i LESS 5)
    set(x ${i})
    set(z 0)
  else()
    set(x 4)
    math(EXPR z "${i} - 4")
  endif()
  math(EXPR x2 "2 * ${x}")
  math(EXPR z2 "2 * ${z}")
  math(EXPR y "${i} % 2")
  string(APPEND truth "10${i}.5 ${x} ${y} ${z} 0 0 0 1\n")
  math(EXPR y2 "2 * ${y}")
  string(APPEND doubled "10${i}.51 ${x2} ${y2} ${z2} 0 0 0 1\n")
  string(APPEND late "90${i}.5 ${x} ${y} ${z} 0 0 0 1\n")
  string(APPEND matrices "1 0 0 ${x} 0 1 0 ${y} 0 0 1 ${z}\n")
  string(APPEND upside_down "10${i}.5 ${x} -${y} ${z} 0 0 0 1\n")
endforeach()
file(WRITE ${folder}/truth.txt "${truth}")
file(WRITE ${folder}/doubled.txt "${doubled}")
file(WRITE ${folder}/late.txt "${late}")
file(WRITE ${folder}/matrices.txt "${matrices}")
file(WRITE ${folder}/upside_down.txt "${upside_down}")
file(WRITE ${folder}/empty.txt "")
string(REPLACE "103.5 3" "103.5 nan" flawed "${truth}")
file(WRITE ${folder}/flawed.txt "${flawed}")
file(WRITE ${folder}/disordered.txt "${truth}104.5 4 0 0 0 0 0 1\n")
file(WRITE ${folder}/two_poses.txt "101.5 0 0 0 0 0 0 1\n102.5 1 0 0 0 0 0 1\n")

sslam_cli_test(NAME "eval finds the scale" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt
               OUT "compared +10," "alignment +sim3, scale 0\\.5" "position \\(ATE\\) +0\\.0000 +0\\.0000" "RPE 1 frame, translation +0\\.0000")
# Without a scale: doubled positions are off by as much as the truth's distance from its middle.
sslam_cli_test(NAME "eval without scale" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --align se3
               OUT "alignment +se3" "position \\(ATE\\) +2.3452")
sslam_cli_test(NAME "eval without alignment" ARGS eval ${folder}/truth.txt ${folder}/truth.txt --align none --frames 20 --delta 2f
               OUT "frames tracked +10 of 20 \\(50\\.0 %\\)" "alignment +none" "RPE 2 frames, rotation +0\\.0000")
sslam_cli_test(NAME "eval turns y over on demand" ARGS eval ${folder}/upside_down.txt ${folder}/truth.txt --align none --axes y-up
               OUT "position \\(ATE\\) +0\\.0000" ERR "sslam: note: .*upside_down.txt: poses with y up")
sslam_cli_test(NAME "eval writes JSON" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --json ${folder}/figures.json
               OUT "ATE" FILE ${folder}/figures.json REGEX "\"scale\": 0.(5|4999999).*\"ate_m\".*\"rmse\".*\"rotation_deg\".*\"rpe\"")
sslam_cli_test(NAME "eval draws a plot" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --plot ${folder}/plot.svg
               OUT "ATE" FILE ${folder}/plot.svg REGEX "^<svg .*ground truth.*doubled.txt.*position error, m.*yaw, degrees.*</svg>")
sslam_cli_test(NAME "eval draws a PDF" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --plot ${folder}/plot.pdf
               OUT "ATE" FILE ${folder}/plot.pdf REGEX "^%PDF-1.4.*position error, m.*%%EOF")

sslam_cli_test(NAME "eval of a missing file" ARGS eval ${folder}/none.txt ${folder}/truth.txt CODE 1
               ERR "^sslam: error: .*none.txt: cannot open: No such file or directory\n$")
sslam_cli_test(NAME "eval of an empty file" ARGS eval ${folder}/truth.txt ${folder}/empty.txt CODE 1
               ERR "^sslam: error: .*empty.txt: holds no pose; expected rows of 'stamp tx ty tz qx qy qz qw' \\(TUM\\), [^\n]*\n$")
sslam_cli_test(NAME "eval of poses without stamps" ARGS eval ${folder}/matrices.txt ${folder}/truth.txt CODE 1
               ERR "^sslam: error: .*matrices.txt: its poses have no stamps; put their times into times.txt beside it or name them with --times\n$")
sslam_cli_test(NAME "eval without overlap" ARGS eval ${folder}/truth.txt ${folder}/late.txt CODE 1
               ERR "^sslam: error: no overlap between ground truth \\(stamps 100.500000 to 109.500000\\) and estimate \\(900.5")
sslam_cli_test(NAME "eval of two poses" ARGS eval ${folder}/truth.txt ${folder}/two_poses.txt CODE 1
               ERR "^sslam: error: alignment needs at least 3 pairs of poses, found 2 within 0.02")
sslam_cli_test(NAME "eval skips a flawed row" ARGS eval ${folder}/flawed.txt ${folder}/truth.txt
               OUT "compared +9," ERR "^sslam: warning: .*flawed.txt: 1 of 10 poses mean 'no pose here' [^\n]*: left out\n$")
sslam_cli_test(NAME "eval puts stamps in order" ARGS eval ${folder}/truth.txt ${folder}/disordered.txt
               OUT "compared +10," ERR "disordered.txt: stamps go backwards at 104.500000: poses sorted by stamp"
               "disordered.txt: 1 repeated stamps, the first at 104.500000: the first pose of each is kept")
sslam_cli_test(NAME "eval with an unwritable JSON" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --json ${folder}/truth.txt/a.json
               CODE 1 ERR "sslam: error: .*a.json: cannot write: Not a directory")
sslam_cli_test(NAME "eval with an unwritable plot" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --plot ${folder}/truth.txt/a.png
               CODE 1 OUT "ATE" ERR "sslam: error: .*a.png: cannot write: Not a directory")
sslam_cli_test(NAME "eval with a plot of another kind" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt --plot ${folder}/plot.jpg
               CODE 2 ERR "sslam: error: --plot: .*plot.jpg' does not end in .svg, .pdf or .png")
sslam_cli_test(NAME "eval with an unknown alignment" ARGS eval a b --align affine CODE 2 ERR "sslam: error: --align")
sslam_cli_test(NAME "eval with a wrong step" ARGS eval a b --delta 1m CODE 2
               ERR "sslam: error: --delta: '1m' is not a step such as 1f or 0.5s")
sslam_cli_test(NAME "eval without an estimate" ARGS eval a CODE 2 ERR "sslam: error: ESTIMATE is required")
sslam_cli_test(NAME "no subcommand" ARGS "" CODE 2 ERR "sslam: error: A subcommand is required")
sslam_cli_test(NAME "help tells the exit codes" ARGS eval --help OUT "Exit codes: 0 success")
sslam_cli_test(NAME "version" ARGS --version OUT "^sslam ${PROJECT_VERSION}\n$")

# Other programs' formats, several estimates, clocks that differ.
set(times "")
set(nanoseconds "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n")
set(still "")
foreach(i RANGE 0 9)
  string(APPEND times "10${i}.5\n")
  string(APPEND still "10${i}.5 0.3 0.2 0.1 0 0 0 1\n")
endforeach()
foreach(i RANGE 0 9)
  if(i LESS 5)
    set(place "${i},0,0")
  else()
    math(EXPR z "${i} - 4")
    set(place "4,0,${z}")
  endif()
  string(APPEND nanoseconds "134183653${i}500000000,${place},1,0,0,0\n")
endforeach()
file(WRITE ${folder}/stamps.list "${times}")
file(WRITE ${folder}/still.txt "${still}")
file(WRITE ${folder}/nanoseconds.csv "${nanoseconds}")
file(MAKE_DIRECTORY ${folder}/a_run)
file(WRITE ${folder}/a_run/trajectory.txt "${doubled}")
sslam_cli_test(NAME "eval of KITTI with its times" ARGS eval ${folder}/matrices.txt ${folder}/truth.txt --times ${folder}/stamps.list --align none
               OUT "compared +10," "position \\(ATE\\) +0\\.0000")
sslam_cli_test(NAME "eval of EuRoC against itself, moved by an offset" ARGS eval ${folder}/nanoseconds.csv ${folder}/nanoseconds.csv --offset 0.01
               OUT "compared +10," "position \\(ATE\\) +0\\.0000" ERR "nanoseconds.csv: stamps in nanoseconds")
sslam_cli_test(NAME "eval of several estimates" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt ${folder}/a_run ${folder}/truth.txt --json ${folder}/several.json
               OUT "doubled.txt\n.*scale 0\\.5.*a_run\n.*scale 0\\.5.*truth.txt\n.*scale 1\n"
               FILE ${folder}/several.json REGEX "\"estimates\".*doubled.txt.*a_run.*truth.txt")
sslam_cli_test(NAME "eval of several estimates, of which one is of no use" ARGS eval ${folder}/truth.txt ${folder}/empty.txt ${folder}/doubled.txt CODE 1
               OUT "scale 0\\.5" ERR "^sslam: error: .*empty.txt: holds no pose")
sslam_cli_test(NAME "eval of an estimate that stands still" ARGS eval ${folder}/truth.txt ${folder}/still.txt CODE 1
               ERR "^sslam: error: alignment with scale needs motion: the estimate stands still\n$")
sslam_cli_test(NAME "eval draws several estimates" ARGS eval ${folder}/truth.txt ${folder}/doubled.txt ${folder}/truth.txt --plot ${folder}/plots.svg
               OUT "ATE" FILE ${folder}/plots.svg REGEX "ground truth.*>[^<]*doubled.txt<.*>[^<]*truth.txt<")

# A folder in TUM layout is its own ground truth, and tells how many frames there were.
set(dataset ${folder}/tum)
file(MAKE_DIRECTORY ${dataset}/rgb)
set(list "")
foreach(i RANGE 0 9)
  file(WRITE ${dataset}/rgb/${i}.png "")
  string(APPEND list "10${i}.5 rgb/${i}.png\n")
endforeach()
file(WRITE ${dataset}/rgb.txt "${list}")
file(WRITE ${dataset}/groundtruth.txt "${truth}")
sslam_cli_test(NAME "eval against a dataset" ARGS eval ${dataset} ${folder}/flawed.txt
               OUT "frames tracked +9 of 10 \\(90\\.0 %\\)" ERR "flawed.txt: 1 of 10 poses mean")
sslam_cli_test(NAME "eval against a dataset's file" ARGS eval ${dataset}/groundtruth.txt ${folder}/doubled.txt
               OUT "frames tracked +10 of 10")
file(MAKE_DIRECTORY ${folder}/nothing)
sslam_cli_test(NAME "eval against no dataset" ARGS eval ${folder}/nothing ${folder}/truth.txt CODE 1
               ERR "^sslam: error: .*nothing: the folder is empty.* looked for rgb.txt")
