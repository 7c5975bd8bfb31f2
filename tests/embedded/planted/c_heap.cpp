// SPDX-License-Identifier: BSD-3-Clause
// Must be seen as: needs malloc
#include <cstdlib>

void* planted(unsigned size) {
  return std::malloc(size);
}
