// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/core/sha256.hpp"

#include <string>

#include "support/catch.hpp"

// The standard's examples, and a text of many blocks.
TEST_CASE("SHA-256 is right") {
  CHECK(sslam::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sslam::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sslam::sha256(std::string(1000, 'a')) ==
        "41edece42d63e8d9bf515a9ba6932e1c20cbc9f5a5d134645adb5db1b9737ea3");
}
