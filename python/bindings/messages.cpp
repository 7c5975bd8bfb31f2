// SPDX-License-Identifier: BSD-3-Clause
// What the command line's readers say goes to Python's warnings instead of standard error, which is the
// program's own here: what decoders print is left alone.
#include "cli/shell/messages.hpp"

#include "bindings/messages.hpp"
#include "cli/input/quiet_decoders.hpp"

namespace sslam {
namespace python {
namespace {

thread_local std::vector<std::string> heard;

}  // namespace

std::vector<std::string> take_messages() {
  return std::exchange(heard, {});
}

}  // namespace python

namespace cli {

void print_note(const std::string& text) {
  python::heard.push_back(text);
}

QuietDecoders::QuietDecoders() = default;
QuietDecoders::~QuietDecoders() = default;

}  // namespace cli
}  // namespace sslam
