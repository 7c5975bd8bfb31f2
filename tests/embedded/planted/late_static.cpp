// SPDX-License-Identifier: BSD-3-Clause
// Must be seen as: needs __cxa_guard_acquire
int slow_value();

int planted() {
  static const int value = slow_value();
  return value;
}
