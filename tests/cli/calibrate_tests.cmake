# `sslam calibrate`: what it says. What it finds is tested in calibrate_test.cpp.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/calibrate)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/empty)
file(WRITE ${folder}/file "not a folder\n")
file(WRITE ${folder}/text.png "no image\n")
set(image ${PROJECT_SOURCE_DIR}/tests/opencv/fixtures/room.jpg)

sslam_cli_test(NAME "calibrate without a board" ARGS calibrate ${image} --out ${folder}/camera.yaml CODE 1
               ERR "sslam: error: [^\n]*no board of 9x6 inner corners in any of 1 images; check --pattern and --size[^\n]*\n$")
sslam_cli_test(NAME "calibrate of nothing" ARGS calibrate ${folder}/none CODE 1 ERR "^sslam: error: [^\n]*none: no such file or folder\n$")
sslam_cli_test(NAME "calibrate of an empty folder" ARGS calibrate ${folder}/empty CODE 1 ERR "^sslam: error: [^\n]*empty: the folder is empty")
sslam_cli_test(NAME "calibrate of a broken image" ARGS calibrate ${folder}/text.png --out ${folder}/camera.yaml CODE 1
               ERR "sslam: error: [^\n]*text.png: cannot decode this image\n$")
sslam_cli_test(NAME "calibrate below a file" ARGS calibrate ${image} --out ${folder}/file/camera.yaml CODE 1
               ERR "^sslam: error: [^\n]*file: cannot make this folder")
sslam_cli_test(NAME "calibrate with more markers than codes" ARGS calibrate ${image} --pattern charuco --size 20x20 CODE 2
               ERR "^sslam: error: --size 20x20: has 200 markers, and --dictionary 4x4_50 50\n$")
sslam_cli_test(NAME "calibrate with an unknown dictionary" ARGS calibrate ${image} --pattern charuco --dictionary 3x3 CODE 2
               ERR "^sslam: error: --dictionary 3x3: not known; use one of 4x4_50, ")
sslam_cli_test(NAME "calibrate with a large marker" ARGS calibrate ${image} --pattern charuco --marker 0.03 CODE 2
               ERR "^sslam: error: --marker 0.03: must be smaller than --square 0.025\n$")
sslam_cli_test(NAME "calibrate with a wrong size" ARGS calibrate ${image} --size 9 CODE 2 ERR "--size: '9' is not a size such as 9x6")
sslam_cli_test(NAME "calibrate with an unknown pattern" ARGS calibrate ${image} --pattern circles CODE 2 ERR "sslam: error: --pattern")
sslam_cli_test(NAME "calibrate with no square" ARGS calibrate ${image} --square 0 CODE 2 ERR "sslam: error: --square")
# Squares that were measured in millimetres, centimetres or inches; a large board that may be.
sslam_cli_test(NAME "calibrate with squares in millimetres" ARGS calibrate ${image} --square 25 CODE 2
               ERR "^sslam: error: --square 25: is in metres, and makes a board 250 m long; for 25 mm type --square 0.025, for 25 cm type --square 0.25\n$")
sslam_cli_test(NAME "calibrate with squares and markers in millimetres" ARGS calibrate ${image} --pattern charuco --size 5x7 --square 40 --marker 30 CODE 2
               ERR "makes a board 280 m long; for 40 mm type --square 0.04 --marker 0.03\n$")
sslam_cli_test(NAME "calibrate with squares in centimetres" ARGS calibrate ${image} --square 2.5 CODE 2
               ERR "; for 2.5 cm type --square 0.025\n$")
sslam_cli_test(NAME "print a board in millimetres" ARGS calibrate --print ${folder}/huge.pdf --square 25 CODE 2 ERR "for 25 mm type --square 0.025")
sslam_cli_test(NAME "calibrate with a square of a hundred kilometres" ARGS calibrate ${image} --square 100000 CODE 2
               ERR "expected the side of one square in metres, such as 0.025\n$")
sslam_cli_test(NAME "calibrate with a large board" ARGS calibrate ${image} --square 0.5 CODE 1 ERR "sslam: error: [^\n]*: no board of 9x6")
sslam_cli_test(NAME "calibrate without images" ARGS calibrate CODE 2 ERR "^sslam: error: IMAGES is required")
sslam_cli_test(NAME "calibrate explains itself" ARGS calibrate --help OUT "--pattern" "--size" "4x4_50" "Exit codes: 0 success")
