# Compiles SOURCE with every kernel for a 32-bit Arm processor, as firmware is compiled, and runs it under qemu. Both come
# from Debian (g++-arm-linux-gnueabihf, qemu-user); without them the test says that it was skipped.
find_program(compiler arm-linux-gnueabihf-g++)
if(NOT compiler)
  message(STATUS "SKIPPED: no arm-linux-gnueabihf-g++ here")
  return()
endif()
get_filename_component(folder "${PROGRAM}" DIRECTORY)
file(MAKE_DIRECTORY "${folder}")
# Two steps, so that a compiler cache can keep the first.
execute_process(COMMAND ${LAUNCHER} ${compiler} -std=c++20 -O1 -DNDEBUG -fno-exceptions -fno-rtti -Wall -Wextra -Wpedantic
                        -Wshadow -Werror -Wno-psabi -I${INCLUDE} -I${TESTS} -isystem ${EIGEN} -c ${SOURCE} -o ${PROGRAM}.o
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${compiler} ${PROGRAM}.o -o ${PROGRAM} COMMAND_ERROR_IS_FATAL ANY)

find_program(emulator qemu-arm)
if(NOT emulator)
  message(STATUS "SKIPPED: compiled, but no qemu-arm here to run it")
  return()
endif()
execute_process(COMMAND ${emulator} -L /usr/arm-linux-gnueabihf ${PROGRAM} COMMAND_ERROR_IS_FATAL ANY)
