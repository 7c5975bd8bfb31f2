// SPDX-License-Identifier: BSD-3-Clause
#include "cli/foxglove/endpoint.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {

std::optional<Endpoint> parse_endpoint(const std::string& text) {
  constexpr int kLastPort = 65535;
  Endpoint endpoint;
  const auto colon = text.rfind(':');
  const auto port = io::parse_number<int>(colon == std::string::npos ? text : text.substr(colon + 1));
  if (!port || *port < 0 || *port > kLastPort) return std::nullopt;
  endpoint.port = *port;
  if (colon != std::string::npos) endpoint.address = text.substr(0, colon);
  in_addr ignored{};
  if (inet_pton(AF_INET, endpoint.address.c_str(), &ignored) != 1) return std::nullopt;
  return endpoint;
}

// The library that listens does not say why it cannot.
void check_endpoint(const Endpoint& endpoint) {
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(static_cast<std::uint16_t>(endpoint.port));
  inet_pton(AF_INET, endpoint.address.c_str(), &name.sin_addr);
  const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const bool free =
      bind(file, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0 && listen(file, 1) == 0;
  const int reason = errno;
  close(file);
  if (free) return;
  const std::string option = "--foxglove " + endpoint.address + ":" + std::to_string(endpoint.port);
  if (reason == EADDRINUSE)
    throw Error(option + ": is in use by another program; choose another port, or 0 for any free one");
  if (reason == EADDRNOTAVAIL)
    throw Error(option + ": is no address of this machine; choose 127.0.0.1, or 0.0.0.0 for all of them");
  throw Error(option + ": cannot be opened (" + std::strerror(reason) + "); choose another port");
}

}  // namespace sslam::cli
