// SPDX-License-Identifier: BSD-3-Clause
// Where `sslam run --foxglove` listens.
#pragma once

#include <optional>
#include <string>

namespace sslam::cli {

inline constexpr int kFoxglovePort = 8765;  // which Foxglove suggests

struct Endpoint {
  std::string address = "127.0.0.1";  // IPv4, in numbers; 0.0.0.0: all of this machine's
  int port = kFoxglovePort;           // 0: any free one
};

// "PORT" or "ADDRESS:PORT"; nothing for another text.
[[nodiscard]] std::optional<Endpoint> parse_endpoint(const std::string& text);

// Throws Error, which names the option, where nobody can listen there.
void check_endpoint(const Endpoint& endpoint);

}  // namespace sslam::cli
