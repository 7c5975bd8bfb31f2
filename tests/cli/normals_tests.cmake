# `sslam normals`: what it says. What it writes is tested in normals_test.cpp.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/normals)
set(fixtures ${PROJECT_SOURCE_DIR}/tests/opencv/fixtures)
set(tiny --model ${fixtures}/tiny_normals.onnx --quiet)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/empty ${folder}/papers ${folder}/flawed)
file(WRITE ${folder}/file "not a folder\n")
file(WRITE ${folder}/papers/notes.txt "no image\n")
file(WRITE ${folder}/text.png "no image\n")
file(WRITE ${folder}/junk.onnx "no model\n")
file(READ ${fixtures}/tiny_normals.json manifest)
string(REPLACE "tiny_normals.onnx" "junk.onnx" manifest "${manifest}")
file(WRITE ${folder}/junk.json "${manifest}")
file(WRITE ${folder}/lonely.onnx "no model\n")
file(WRITE ${folder}/room.yaml "%YAML:1.0\n---\nCamera.fx: 260\nCamera.fy: 260\nCamera.cx: 159.5\nCamera.cy: 119.5\n")
foreach(name a c)
  file(COPY_FILE ${fixtures}/room.jpg ${folder}/flawed/${name}.jpg)
endforeach()
file(WRITE ${folder}/flawed/b.jpg "no image\n")

sslam_cli_test(NAME "normals of one image" ARGS normals ${fixtures}/room.jpg --camera ${folder}/room.yaml --quiet --out ${folder}/one
               OUT "^images +1 of 1\nplanar +[0-9.]+ % of the pixels\ninference +median [0-9.]+ ms an image\n"
               "model +[^\n]*planar_normals.onnx\nwritten to +[^\n]*normals/one: NAME.png"
               FILE ${folder}/one/encoding.txt REGEX "^r=\\+x g=\\+y b=\\+z plane_sigma_deg=4.7\n$")
sslam_cli_test(NAME "normals assumes a camera and says so" ARGS normals ${fixtures}/room.jpg ${tiny} --out ${folder}/assumed
               OUT "images +1 of 1" ERR "^sslam: note: the camera is not known: assuming a focal length of 256 pixels for 320x240[^\n]*\n$")
sslam_cli_test(NAME "normals goes on over a bad image" ARGS normals ${folder}/flawed ${tiny} --out ${folder}/flawed_out
               OUT "images +2 of 3" ERR "sslam: warning: [^\n]*flawed/b.jpg: cannot decode this image\n$")
sslam_cli_test(NAME "normals takes a glob" ARGS normals "${folder}/flawed/?.jpg" ${tiny} --out ${folder}/glob_out
               OUT "images +2 of 3" ERR "flawed/b.jpg: cannot decode this image")

# sslam_normals_refuses(WHAT REGEX argument...): exit code 1 and one line.
function(sslam_normals_refuses what regex)
  sslam_cli_test(NAME "normals of ${what}" ARGS normals ${ARGN} CODE 1 ERR "^(sslam: note: [^\n]*\n)?sslam: error: [^\n]*${regex}[^\n]*\n$")
endfunction()
sslam_normals_refuses("nothing" "nowhere: no such file or folder" ${folder}/nowhere ${tiny})
sslam_normals_refuses("an empty folder" "empty: the folder is empty" ${folder}/empty ${tiny})
sslam_normals_refuses("a folder without images" "papers: no dataset here" ${folder}/papers ${tiny})
sslam_normals_refuses("another file" "notes.txt: is neither an image" ${folder}/papers/notes.txt ${tiny})
sslam_normals_refuses("a broken image" "text.png: cannot decode this image" ${folder}/text.png ${tiny} --out ${folder}/none)
sslam_normals_refuses("a glob that matches nothing" "no image matches" ${folder}/*.bmp ${tiny})
file(WRITE ${folder}/other.yaml "Camera.fx: 260\nCamera.fy: 260\nCamera.cx: 319.5\nCamera.cy: 179.5\nCamera.width: 640\nCamera.height: 360\n")
sslam_normals_refuses("an image of another camera" "other.yaml: is for 640x360 pixels, and the images have 320x240: another aspect ratio"
                      ${fixtures}/room.jpg ${tiny} --camera ${folder}/other.yaml --out ${folder}/none)
sslam_normals_refuses("an unknown camera" "absent.yaml" ${fixtures}/room.jpg ${tiny} --camera ${folder}/absent.yaml)
sslam_normals_refuses("a missing model" "absent.onnx: no such model" ${fixtures}/room.jpg --model ${folder}/absent.onnx)
sslam_normals_refuses("a model without manifest" "lonely.json: no such manifest" ${fixtures}/room.jpg --model ${folder}/lonely.onnx)
sslam_normals_refuses("a file that is no model" "junk.onnx: no ONNX model" ${fixtures}/room.jpg --model ${folder}/junk.onnx)
sslam_normals_refuses("an output below a file" "file/below: cannot make this folder" ${fixtures}/room.jpg ${tiny} --out ${folder}/file/below)
sslam_normals_refuses("its own folder" "contains the images themselves" ${folder}/flawed ${tiny} --out ${folder}/flawed)
sslam_cli_test(NAME "normals without images" ARGS normals CODE 2 ERR "sslam: error: IMAGES is required")
sslam_cli_test(NAME "normals explains itself" ARGS normals --help OUT "--model" "--camera" "--out" "Exit codes: 0 success")
