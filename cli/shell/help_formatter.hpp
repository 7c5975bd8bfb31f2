// SPDX-License-Identifier: BSD-3-Clause
// --help, wrapped to the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sslam::cli {

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  // `left` in the first column, `text` in the second.
  [[nodiscard]] std::string two_columns(const std::string& left, const std::string& text) const;

  std::size_t width_;
};

// `text` in lines of at most `width`; those behind the first begin with `indent` blanks. Its own line breaks
// stay.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);

// Puts options, by their long names, under a heading of their own.
void put_in_group(CLI::App& command, const std::string& heading, std::initializer_list<const char*> options);

}  // namespace sslam::cli
