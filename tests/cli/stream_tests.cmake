# Cameras, streams and pipes, played by a script of our own, and a driver played by a library.
add_library(fake_camera MODULE stream/fake_camera.cpp)
sslam_own_target(fake_camera)
target_link_libraries(fake_camera PRIVATE ${CMAKE_DL_LIBS})
foreach(case pipe broken_pipe video network rtsp device lost silent refusals)
  add_test(NAME "cli: stream ${case}" COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/stream/stream.py $<TARGET_FILE:sslam> ${case}
                                              $<TARGET_FILE:fake_camera>)
endforeach()
