// SPDX-License-Identifier: BSD-3-Clause
// Files of options, for a command with an option of each kind.
#include "cli/shell/config_file.hpp"

#include <CLI/CLI.hpp>

#include "fuzz/fuzz_input.hpp"
#include "fuzz/seeds.hpp"

namespace config_fuzz {

inline const std::vector<std::string>& seeds() {
  static const std::vector<std::string> kSeeds{
      "end = 40\nfov = 60.5\nlive = true\nnormals = 'none'\nport = 8080\n[set]\nkeyframes.max_turn = "
      "10\nmap.a.b = 1e-3\n",
      "topics = ['/a', \"/b\\u00e9\"]\nend = -1\nport = 'any'\nset = {a.b = 0.3, c = 2}\n",
      "config = 'other'\n", "ende = 1979-05-27T07:32:00Z\n"};
  return kSeeds;
}

}  // namespace config_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(config_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    sslam::fuzzing::expect_message([&] {
      CLI::App command("", "run");
      int end = 0;
      double fov = 0;
      bool live = false;
      std::string normals, port;
      std::vector<std::string> topics, set;
      command.add_option("--end", end)->type_name("INT");
      command.add_option("--fov", fov)->type_name("DEGREES");
      command.add_flag("--live", live);
      command.add_option("--normals", normals)->type_name("HOW");
      command.add_option("--port", port)->type_name("PORT");
      command.add_option("--topics", topics);
      command.add_option("--set", set);
      std::map<std::string, std::string> places;
      sslam::cli::add_config_option(command, &places);
      try {
        command.parse(std::vector<std::string>{path.string(), "--config"});  // from the last to the first
      } catch (const CLI::Error&) {
      }
    });
  });
}
