// SPDX-License-Identifier: BSD-3-Clause
// Must be seen as: needs _Znw
int* planted(int value) {
  return new int(value);
}
