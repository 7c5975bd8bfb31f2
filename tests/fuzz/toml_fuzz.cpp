// SPDX-License-Identifier: BSD-3-Clause
// Suites: what is let through to the parser must not overflow its stack.
#include "cli/shell/toml_parser.hpp"

#include "cli/shell/toml_text.hpp"
#include "fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    try {
      (void)toml::parse(sslam::cli::read_toml_text(path));
    } catch (const toml::parse_error&) {
    }
  });
}
