// SPDX-License-Identifier: BSD-3-Clause
// toml++ without its assertions: "[^.c]" contradicts one. It would end the program in Debug, and with clang
// in Release be an assumption for the optimiser. Without them, the parser reports such a file as an error.
#pragma once

#pragma push_macro("NDEBUG")
#undef NDEBUG  // which would bring the assumptions
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
