// SPDX-License-Identifier: BSD-3-Clause
// Must be seen as: bytes of stack, more than
void fill(char* bytes);

__attribute__((noinline)) static void inner() {
  char bytes[3000];
  fill(bytes);
}

void planted() {
  char bytes[3000];
  fill(bytes);
  inner();
}
