// SPDX-License-Identifier: BSD-3-Clause
// A WebSocket server in a thread of its own: advertises channels to its clients, and sends them messages.
// Nobody who hands messages over ever waits for a client.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "cli/foxglove/client_queue.hpp"
#include "cli/foxglove/endpoint.hpp"

struct lws;
struct lws_context;

namespace sslam::cli {

class SocketServer {
 public:
  // Called in the server's thread after wake(): what is new.
  using Source = std::function<std::vector<StreamMessage>()>;

  // At most 32 channels. Throws Error where nobody can listen.
  SocketServer(Endpoint endpoint, std::vector<StreamChannel> channels, Source source);
  // Gives clients two seconds to take what waits for them, and says goodbye.
  ~SocketServer();
  SocketServer(const SocketServer&) = delete;
  SocketServer& operator=(const SocketServer&) = delete;

  // With the token in it.
  [[nodiscard]] std::string address() const;

  // Whether a client has subscribed to the channel. Any thread may ask.
  [[nodiscard]] bool wanted(std::size_t channel) const noexcept {
    return (wanted_.load(std::memory_order_relaxed) >> channel & 1U) != 0;
  }

  // There is something new. Any thread may say so; returns at once.
  void wake() noexcept;

 private:
  struct Client {
    explicit Client(std::span<const StreamChannel> channels) : queue(channels) {}
    ClientQueue queue;
    std::string incoming;  // of a message in parts
  };
  friend struct SocketCalls;  // the library's callback

  [[nodiscard]] bool knows_token(lws* connection) const;
  void open(lws* connection);
  [[nodiscard]] bool receive(lws* connection, std::string_view part);
  [[nodiscard]] bool write(lws* connection);
  void close(lws* connection);
  void take_new();
  void answer(Client& client, std::string_view text);
  void note_wishes();
  void serve();

  Endpoint endpoint_;
  std::vector<StreamChannel> channels_;
  Source source_;
  std::string token_, session_, advertisement_;
  std::map<lws*, Client> clients_;   // of the server's thread, and so is the next one
  std::vector<StreamMessage> last_;  // by channel; without bytes where there was none
  std::atomic<std::uint32_t> wanted_ = 0;
  std::atomic<bool> ending_ = false, over_ = false;
  std::mutex mutex_;  // for what follows
  std::condition_variable changed_;
  bool empty_ = false;  // at the end: all clients are gone
  lws_context* context_ = nullptr;
  std::thread thread_;
};

}  // namespace sslam::cli
