# `sslam synth`: what it says. What it writes is tested in synth_test.cpp.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/synth)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/foreign)
file(WRITE ${folder}/foreign/rgb.txt "0.0 rgb/0.png\n")
file(WRITE ${folder}/file "not a folder\n")

sslam_cli_test(NAME "synth tells how much and how fast" ARGS synth ${folder}/small --size 64x48 --frames 2 --texture poor
               OUT "small: 2 frames, 0\\.0 m, .* frames/s\n$" ERR "2/2 .*/s +rendered\n$" FILE ${folder}/small/rgb.txt
               REGEX "0\\.000000 rgb/000000\\.jpg\n0\\.033333 rgb/000001\\.jpg\n$")

# sslam_synth_refuses(OPTION VALUE REGEX): exit code 2 and the option's name.
function(sslam_synth_refuses option value regex)
  sslam_cli_test(NAME "synth refuses ${option} ${value}" ARGS synth ${folder}/refused ${option} ${value} CODE 2
                 ERR "^sslam: error: ${option}: .*${regex}.*\n$")
endfunction()
sslam_synth_refuses(--frames 0 "not in range")
sslam_synth_refuses(--frames 1.5 "1.5")
sslam_synth_refuses(--noise nan "expected a number between 0 and 100, found 'nan'")
sslam_synth_refuses(--fps inf "expected a number between")
sslam_synth_refuses(--blur 2 "between 0 and 1")
sslam_synth_refuses(--size 640 "'640' is not a size such as 640x480")
sslam_synth_refuses(--size 640x480x3 "is not a size")
sslam_synth_refuses(--rooms 51 "51 not in range")
sslam_synth_refuses(--texture velvet "'velvet' is not one of mixed, poor, rich")
sslam_synth_refuses(--seed -1 "'-1' is not a whole number")
sslam_synth_refuses(--threads 0 "not in range")
sslam_synth_refuses(--lens 0.1 "'0.1' is not a lens such as")
sslam_synth_refuses(--lens 0.1,nan "is not a lens")
sslam_synth_refuses(--camera-error zoom=2 "'zoom=2' is not an error of a camera; expected errors such as focal=0.05")
sslam_synth_refuses(--camera-error focal=-1 "needs a number between -0.9 and 0.9")
sslam_synth_refuses(--camera-like toaster "'toaster' is not one of industrial, kinect, phone, webcam")
sslam_synth_refuses(--jpeg-quality 101 "not in range")
sslam_synth_refuses(--off-square -1 "expected a number between 0 and 8, found '-1'")
sslam_synth_refuses(--off-square nan "expected a number between 0 and 8, found 'nan'")
sslam_synth_refuses(--off-square 8.1 "between 0 and 8")
sslam_synth_refuses(--clutter -1 "-1 not in range")
sslam_synth_refuses(--clutter 201 "not in range")
sslam_synth_refuses(--clutter nan "nan")
sslam_synth_refuses(--image-fixed spots "'spots' is not one of bar, dots, none, text")
sslam_cli_test(NAME "synth of a quality without JPEG" ARGS synth ${folder}/refused --camera-like industrial --jpeg-quality 80 CODE 2
               ERR "^sslam: error: --jpeg-quality: needs --image-format jpg.*\n$")
sslam_cli_test(NAME "synth through a lens that turns back" ARGS synth ${folder}/refused --lens -0.9,0 CODE 1
               ERR "^sslam: error: --lens -0\.9,0,0,0: the distortion folds the image back.*--focal longer than 480\n$")
sslam_cli_test(NAME "synth with a read-out longer than a frame" ARGS synth ${folder}/refused --read-out 0.05 CODE 1
               ERR "^sslam: error: --read-out 0\.05 is longer than a frame: expected at most 0\.03333 s at --fps 30\n$")

sslam_cli_test(NAME "synth below a file" ARGS synth ${folder}/file/below --frames 2 CODE 1
               ERR "^sslam: error: .*file/below: cannot make this folder.*\n$")
sslam_cli_test(NAME "synth into a file" ARGS synth ${folder}/file --frames 2 CODE 1
               ERR "^sslam: error: .*file: cannot make this folder.*\n$")
sslam_cli_test(NAME "synth over another data set" ARGS synth ${folder}/foreign --frames 2 CODE 1
               ERR "^sslam: error: .*foreign: holds a data set that sslam synth did not make.*\n$")
sslam_cli_test(NAME "synth of three oblique rooms" ARGS synth ${folder}/refused --rooms 3 --world oblique CODE 1
               ERR "^sslam: error: several rooms have Manhattan walls.*\n$")
sslam_cli_test(NAME "synth of three rooms off square" ARGS synth ${folder}/refused --rooms 3 --off-square 2 CODE 1
               ERR "^sslam: error: --off-square [^\n]* needs --rooms 1 and --world manhattan\n$")
sslam_cli_test(NAME "synth of a free room off square" ARGS synth ${folder}/refused --world free --off-square 2 CODE 1
               ERR "^sslam: error: --off-square [^\n]* needs --rooms 1 and --world manhattan\n$")
sslam_cli_test(NAME "synth of a floor with doors ajar" ARGS synth ${folder}/refused --rooms 4 --doors-ajar CODE 1
               ERR "^sslam: error: a floor of many rooms [^\n]*--doors-ajar and --clutter need --rooms 1 or 3\n$")
sslam_cli_test(NAME "synth of a floor with clutter" ARGS synth ${folder}/refused --rooms 2 --clutter 5 CODE 1
               ERR "^sslam: error: a floor of many rooms [^\n]*--doors-ajar and --clutter need --rooms 1 or 3\n$")
