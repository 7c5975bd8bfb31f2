// SPDX-License-Identifier: BSD-3-Clause
// Catch2 version 2 needs its main compiled once.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
