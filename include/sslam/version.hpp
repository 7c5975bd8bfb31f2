// SPDX-License-Identifier: BSD-3-Clause
// The version of sslam: CMake, the command line and the packages take it from here.
#pragma once

#define SSLAM_VERSION_MAJOR 0
#define SSLAM_VERSION_MINOR 1
#define SSLAM_VERSION_PATCH 0

#define SSLAM_VERSION_TEXT_(number) #number
#define SSLAM_VERSION_JOIN_(major, minor, patch) \
  SSLAM_VERSION_TEXT_(major) "." SSLAM_VERSION_TEXT_(minor) "." SSLAM_VERSION_TEXT_(patch)
// As a string literal: "0.1.0".
#define SSLAM_VERSION SSLAM_VERSION_JOIN_(SSLAM_VERSION_MAJOR, SSLAM_VERSION_MINOR, SSLAM_VERSION_PATCH)
