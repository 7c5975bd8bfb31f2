// SPDX-License-Identifier: BSD-3-Clause
// Must be seen as: keeps 4 bytes of state
int planted() {
  static int calls = 0;
  return ++calls;
}
