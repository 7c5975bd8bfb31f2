// SPDX-License-Identifier: BSD-3-Clause
// The messages of Foxglove's WebSocket protocol that are of use here. Its server's side: channels are
// advertised, clients subscribe, and data goes to those who did.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/results/ros_messages.hpp"

namespace sslam::cli {

// The subprotocol's two names: that of Foxglove's SDK, which newer programs ask for, and the older one. What
// is used here has the same form in both.
inline constexpr const char* kFoxgloveProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

struct StreamChannel {
  RosTopic topic;
  bool newest_only = false;  // a message makes those before it needless; who subscribes gets the last one
};

// What a client is told first. `session`: tells one server from the next.
[[nodiscard]] std::string server_info(const std::string& session);

// Channels are numbered by their places in the list.
[[nodiscard]] std::string advertisement(std::span<const StreamChannel> channels);

// For people; a fault of the client's.
[[nodiscard]] std::string error_status(const std::string& message);

// The head of a message: its payload follows.
[[nodiscard]] std::string data_head(std::uint32_t subscription, std::int64_t nanoseconds);

struct Subscription {
  std::uint32_t id = 0;  // of the client's choice
  std::size_t channel = 0;
};

struct ClientRequest {
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;
};

// What the client asks for; nothing where it is of no concern to this server. Throws Error, one line, for
// what is no message of the protocol.
[[nodiscard]] ClientRequest parse_request(std::string_view text);

}  // namespace sslam::cli
