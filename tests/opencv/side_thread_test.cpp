// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/side_thread.hpp"

#include <set>
#include <stdexcept>
#include <thread>

#include "support/catch.hpp"

using sslam::SideThread;

TEST_CASE("Work on the side is done in one thread, whatever comes, and waited for") {
  SideThread side;
  std::set<std::thread::id> there, here;
  int done = 0;
  for (int i = 0; i < 100; ++i) {
    int both = 0;
    side.run([&] { there.insert(std::this_thread::get_id()), ++done; },
             [&] { here.insert(std::this_thread::get_id()), ++both; });
    REQUIRE(done == i + 1);
    REQUIRE(both == 1);
  }
  CHECK(there.size() == 1);
  CHECK(here == std::set{std::this_thread::get_id()});
  CHECK(there != here);
}

TEST_CASE("What fails on either side is thrown once both have ended") {
  SideThread side;
  bool other = false;
  CHECK_THROWS_AS(side.run([] { throw std::runtime_error("there"); }, [&] { other = true; }),
                  std::runtime_error);
  CHECK(other);
  other = false;
  CHECK_THROWS_AS(side.run([&] { other = true; }, [] { throw std::logic_error("here"); }), std::logic_error);
  CHECK(other);
  CHECK_NOTHROW(side.run([] {}, [] {}));
}
