// SPDX-License-Identifier: BSD-3-Clause
#include "cli/view/connection_watch.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <filesystem>
#include <optional>

#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto kPause = std::chrono::milliseconds(200), kPauseAtTheEnd = std::chrono::milliseconds(20);
constexpr auto kLongestRequest = std::chrono::seconds(5);
constexpr auto kLongestAnswer = std::chrono::minutes(10);  // megabytes through somebody's tunnel

using NameOf = int (*)(int, sockaddr*, socklen_t*);

// Of one end of an IPv4 connection; nothing where the file is none.
std::optional<int> port_of(int file, NameOf name_of) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (name_of(file, reinterpret_cast<sockaddr*>(&address), &size) != 0 || address.sin_family != AF_INET)
    return std::nullopt;
  return ntohs(address.sin_port);
}

}  // namespace

ConnectionWatch::ConnectionWatch(int port) : port_(port), thread_([this] { watch(); }) {}

ConnectionWatch::~ConnectionWatch() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void ConnectionWatch::request_read(int client_port) {
  const std::lock_guard lock(mutex_);
  read_.insert(client_port);
}

void ConnectionWatch::end_all() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
}

void ConnectionWatch::watch() {
  std::unique_lock lock(mutex_);
  while (!over_) {
    const std::set<Connection> open = open_connections();
    std::erase_if(since_, [&](const auto& entry) { return !open.contains(entry.first); });
    const auto now = Clock::now();
    for (const Connection& connection : open) {
      const auto since = since_.emplace(connection, now).first->second;
      const Clock::duration limit = read_.contains(connection.second) ? Clock::duration(kLongestAnswer)
                                                                      : Clock::duration(kLongestRequest);
      if (ending_ || now - since > limit) shutdown(connection.first, SHUT_RDWR);
    }
    std::set<int> clients;
    for (const Connection& connection : open) clients.insert(connection.second);
    std::erase_if(read_, [&](int client) { return !clients.contains(client); });
    changed_.wait_for(lock, ending_ ? kPauseAtTheEnd : kPause);
  }
}

std::set<ConnectionWatch::Connection> ConnectionWatch::open_connections() const {
  std::set<Connection> open;
  std::error_code error;
  for (auto it = fs::directory_iterator("/proc/self/fd", error); !error && it != fs::directory_iterator();
       it.increment(error)) {
    const auto file = io::parse_number<int>(it->path().filename().string());
    if (!file || port_of(*file, getsockname) != port_) continue;
    if (const auto client = port_of(*file, getpeername)) open.emplace(*file, *client);
  }
  return open;
}

}  // namespace sslam::cli
