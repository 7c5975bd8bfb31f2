// SPDX-License-Identifier: BSD-3-Clause
// Must be seen as: needs _ZSt24__throw_out_of_range
#include <string_view>

char planted(std::string_view text) {
  return text.at(3);
}
