// SPDX-License-Identifier: BSD-3-Clause
// Ends connections to a port of this process that take too long: the HTTP library limits each step of an
// exchange, not the whole, so that a client that sends a byte now and then would keep a worker for ever.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

namespace sslam::cli {

class ConnectionWatch {
 public:
  explicit ConnectionWatch(int port);
  ~ConnectionWatch();
  ConnectionWatch(const ConnectionWatch&) = delete;
  ConnectionWatch& operator=(const ConnectionWatch&) = delete;

  // The request of the client at this port of its own has been read: it has more time for the answer.
  void request_read(int client_port);

  // From now on every connection is ended as soon as it is seen.
  void end_all();

 private:
  using Clock = std::chrono::steady_clock;
  using Connection = std::pair<int, int>;  // our socket, port of the client

  void watch();
  [[nodiscard]] std::set<Connection> open_connections() const;

  int port_;
  std::mutex mutex_;  // for what follows
  std::condition_variable changed_;
  std::map<Connection, Clock::time_point> since_;
  std::set<int> read_;  // ports of clients
  bool ending_ = false, over_ = false;
  std::thread thread_;
};

}  // namespace sslam::cli
