// SPDX-License-Identifier: BSD-3-Clause
// What waits for a client of `sslam run --foxglove`, and where it listens. foxglove/foxglove.py asks the
// server on the wire.
#include <array>
#include <memory>
#include <string>

#include "cli/foxglove/client_queue.hpp"
#include "cli/foxglove/endpoint.hpp"
#include "support/catch.hpp"

namespace foxglove_test {

namespace {

using namespace sslam::cli;

constexpr std::array kChannels{StreamChannel{ros_topics::kTf, false}, StreamChannel{ros_topics::kPath, true}};

StreamMessage message(std::size_t channel, std::int64_t time, const std::string& text) {
  return {channel, time, std::make_shared<const std::string>(text)};
}

std::string payload(ClientQueue& queue) {
  constexpr std::size_t kHead = 1 + 4 + 8;
  bool is_text = false;
  const std::string bytes = queue.take(is_text);
  REQUIRE_FALSE(is_text);
  return bytes.substr(kHead);
}

TEST_CASE("A client that takes nothing keeps the newest state, and the last thousand poses") {
  ClientQueue queue(kChannels);
  queue.subscribe({7, 0});
  queue.subscribe({8, 1});
  for (int i = 0; i < 1500; ++i) {
    queue.add(message(0, i, "pose " + std::to_string(i)));
    queue.add(message(1, i, "path " + std::to_string(i)));
  }
  for (int i = 500; i < 1500; ++i) CHECK(payload(queue) == "pose " + std::to_string(i));
  CHECK(payload(queue) == "path 1499");
  CHECK(queue.empty());
}

TEST_CASE("A message goes out with the client's own number and its time, texts before it") {
  ClientQueue queue(kChannels);
  queue.add(message(0, 1, "nobody has asked"));
  CHECK(queue.empty());
  queue.subscribe({0x01020304, 0});
  queue.add(message(0, 0x0A0B0C0D, "pose"));
  queue.tell("hello");
  bool is_text = false;
  CHECK(queue.take(is_text) == "hello");
  CHECK(is_text);
  CHECK(queue.take(is_text) == std::string("\x01\x04\x03\x02\x01\x0D\x0C\x0B\x0A\0\0\0\0pose", 17));
  CHECK_FALSE(is_text);
}

TEST_CASE("What waits for a subscription goes with it") {
  ClientQueue queue(kChannels);
  queue.subscribe({1, 0});
  queue.add(message(0, 1, "pose"));
  queue.unsubscribe(1);
  CHECK(queue.empty());
  CHECK_THROWS_WITH(queue.unsubscribe(1), "there is no subscription 1");
  queue.subscribe({1, 1});
  CHECK(queue.wants(1));
  CHECK_FALSE(queue.wants(0));
}

TEST_CASE("A client that has more texts to read than it asked for is clogged") {
  ClientQueue queue(kChannels);
  for (int i = 0; i < 100; ++i) queue.tell("fault");
  CHECK_FALSE(queue.is_clogged());
  queue.tell("fault");
  CHECK(queue.is_clogged());
}

TEST_CASE("An endpoint is a port, with an address or without") {
  CHECK(parse_endpoint("0")->address == "127.0.0.1");
  CHECK(parse_endpoint("0")->port == 0);
  CHECK(parse_endpoint("0.0.0.0:65535")->address == "0.0.0.0");
  CHECK(parse_endpoint("0.0.0.0:65535")->port == 65535);
  for (const char* text : {"", ":", ":1", "1:", "-1", "65536", "localhost:1", "1.2.3:4", "1.2.3.4.5:6",
                           "::1:8", "8765 ", "true"})
    CHECK_FALSE(parse_endpoint(text));
}

}  // namespace

}  // namespace foxglove_test
