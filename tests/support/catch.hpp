// SPDX-License-Identifier: BSD-3-Clause
// Catch2 version 2 (one header) and version 3 (a library) under one include.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;  // version 2 puts it there by itself
#else
#include <catch2/catch.hpp>
#endif
