// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/program.hpp"

int main(int argc, char** argv) {
  return sslam::run_program(argc, argv);
}
