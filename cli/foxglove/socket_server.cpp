// SPDX-License-Identifier: BSD-3-Clause
#include "cli/foxglove/socket_server.hpp"

#include <libwebsockets.h>

#include <chrono>
#include <exception>
#include <utility>

#include "cli/view/access_token.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

constexpr std::size_t kMostClients = 32;             // as many as the page's server has workers
constexpr std::size_t kLargestRequest = 64U << 10U;  // bytes; that of all channels has less than one KiB
constexpr auto kFarewell = std::chrono::seconds(2);

// What a client gets that names no subprotocol, and questions about connections as such.
constexpr std::string_view kNoProtocol = "http";

// A client that is silent is asked whether it is there, and ended where it does not say so.
constexpr std::uint16_t kAskAfter = 10, kEndAfter = 30;  // seconds

}  // namespace

// How the library calls; returning another number than 0 ends the connection.
struct SocketCalls {
  static int on(lws* connection, lws_callback_reasons why, void* user, void* in, std::size_t size) noexcept {
    try {
      return handle(connection, why, user, in, size);
    } catch (const std::exception&) {
      return -1;
    }
  }

  static int handle(lws* connection, lws_callback_reasons why, void* user, void* in, std::size_t size) {
    auto& server = *static_cast<SocketServer*>(lws_context_user(lws_get_context(connection)));
    switch (why) {
      case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
        return server.ending_ || server.clients_.size() >= kMostClients ? 1 : 0;
      case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        // Asked again: others may have shaken hands since.
        return lws_get_protocol(connection)->name != kNoProtocol && server.clients_.size() < kMostClients &&
                       server.knows_token(connection)
                   ? 0
                   : 1;
      case LWS_CALLBACK_ESTABLISHED:
        server.open(connection);
        return 0;
      case LWS_CALLBACK_RECEIVE:
        return server.receive(connection, {static_cast<const char*>(in), size}) ? 0 : -1;
      case LWS_CALLBACK_SERVER_WRITEABLE:
        return server.write(connection) ? 0 : -1;
      case LWS_CALLBACK_CLOSED:
        server.close(connection);
        return 0;
      case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        server.take_new();
        return 0;
      default:
        return lws_callback_http_dummy(connection, why, user, in, size);
    }
  }
};

namespace {

const lws_protocols kProtocols[] = {
    {kNoProtocol.data(), SocketCalls::on, 0, 0, 0, nullptr, 0},
    {kFoxgloveProtocols[0], SocketCalls::on, 0, 4096, 0, nullptr, 0},
    {kFoxgloveProtocols[1], SocketCalls::on, 0, 4096, 0, nullptr, 0},
    {nullptr, nullptr, 0, 0, 0, nullptr, 0},
};

lws_context* make_context(const Endpoint& endpoint, SocketServer& server) {
  static constexpr lws_retry_bo_t kPatience = {nullptr, 0, 0, kAskAfter, kEndAfter, 0};
  lws_set_log_level(0, nullptr);
  lws_context_creation_info info{};
  info.port = endpoint.port;
  info.iface = endpoint.address == "0.0.0.0" ? nullptr : endpoint.address.c_str();
  info.protocols = kProtocols;
  info.user = &server;
  info.gid = static_cast<gid_t>(-1);
  info.uid = static_cast<uid_t>(-1);
  info.options = LWS_SERVER_OPTION_DISABLE_IPV6 | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  info.fd_limit_per_thread = 2 * kMostClients;
  info.timeout_secs = 5;
  info.keepalive_timeout = 5;
  info.retry_and_idle_policy = &kPatience;
  return lws_create_context(&info);
}

}  // namespace

SocketServer::SocketServer(Endpoint endpoint, std::vector<StreamChannel> channels, Source source)
    : endpoint_(std::move(endpoint)),
      channels_(std::move(channels)),
      source_(std::move(source)),
      token_(random_token()),
      session_(random_token()),
      advertisement_(advertisement(channels_)),
      last_(channels_.size()) {
  check_endpoint(endpoint_);
  context_ = make_context(endpoint_, *this);
  if (context_ == nullptr)
    throw Error("--foxglove " + endpoint_.address + ":" + std::to_string(endpoint_.port) +
                ": cannot be opened; choose another port, or 0 for any free one");
  endpoint_.port = lws_get_vhost_listen_port(lws_get_vhost_by_name(context_, "default"));
  thread_ = std::thread([this] { serve(); });
}

SocketServer::~SocketServer() {
  ending_ = true;
  wake();
  {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kFarewell, [this] { return empty_; });
  }
  over_ = true;
  wake();
  thread_.join();
  lws_context_destroy(context_);
}

std::string SocketServer::address() const {
  return "ws://" + endpoint_.address + ":" + std::to_string(endpoint_.port) + "/" + token_;
}

void SocketServer::wake() noexcept {
  lws_cancel_service(context_);
}

void SocketServer::serve() {
  while (!over_) lws_service(context_, 0);
}

bool SocketServer::knows_token(lws* connection) const {
  char path[64];
  const int size = lws_hdr_copy(connection, path, sizeof path, WSI_TOKEN_GET_URI);
  return size > 0 && same_text({path, static_cast<std::size_t>(size)}, "/" + token_);
}

void SocketServer::open(lws* connection) {
  Client& client = clients_.emplace(connection, Client(channels_)).first->second;
  client.queue.tell(server_info(session_));
  client.queue.tell(advertisement_);
  lws_callback_on_writable(connection);
}

bool SocketServer::receive(lws* connection, std::string_view part) {
  Client& client = clients_.at(connection);
  if (client.incoming.size() + part.size() > kLargestRequest) {
    lws_close_reason(connection, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, nullptr, 0);
    return false;
  }
  client.incoming += part;
  if (!lws_is_final_fragment(connection) || lws_remaining_packet_payload(connection) > 0) return true;
  const std::string message = std::exchange(client.incoming, {});
  if (lws_frame_is_binary(connection) == 0) answer(client, message);
  if (client.queue.is_clogged()) return false;
  if (!client.queue.empty()) lws_callback_on_writable(connection);
  return true;
}

// Who subscribes to what only its newest message matters of gets that one at once.
void SocketServer::answer(Client& client, std::string_view text) {
  try {
    const ClientRequest request = parse_request(text);
    for (const std::uint32_t id : request.unsubscribe) client.queue.unsubscribe(id);
    for (const Subscription& wish : request.subscribe) {
      client.queue.subscribe(wish);
      if (last_[wish.channel].bytes != nullptr) client.queue.add(last_[wish.channel]);
    }
  } catch (const Error& error) {
    client.queue.tell(error_status(std::string("sslam: the last message: ") + error.what()));
  }
  note_wishes();
}

bool SocketServer::write(lws* connection) {
  ClientQueue& queue = clients_.at(connection).queue;
  if (queue.empty()) {
    if (!ending_) return true;
    lws_close_reason(connection, LWS_CLOSE_STATUS_GOINGAWAY, nullptr, 0);
    return false;
  }
  bool is_text = false;
  std::string bytes(LWS_PRE, '\0');  // the library's room for the frame's head
  bytes += queue.take(is_text);
  const std::size_t size = bytes.size() - LWS_PRE;
  const int sent = lws_write(connection, reinterpret_cast<unsigned char*>(bytes.data()) + LWS_PRE, size,
                             is_text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY);
  if (sent < 0 || static_cast<std::size_t>(sent) < size) return false;
  if (!queue.empty() || ending_) lws_callback_on_writable(connection);
  return true;
}

void SocketServer::close(lws* connection) {
  clients_.erase(connection);
  note_wishes();
  if (ending_) take_new();
}

void SocketServer::take_new() {
  for (StreamMessage& message : source_()) {
    for (auto& [connection, client] : clients_) client.queue.add(message);
    if (channels_[message.channel].newest_only) last_[message.channel] = std::move(message);
  }
  for (auto& [connection, client] : clients_)
    if (!client.queue.empty() || ending_) lws_callback_on_writable(connection);
  if (!ending_ || !clients_.empty()) return;
  const std::lock_guard lock(mutex_);
  empty_ = true;
  changed_.notify_one();
}

void SocketServer::note_wishes() {
  std::uint32_t wanted = 0;
  for (const auto& [connection, client] : clients_)
    for (std::size_t channel = 0; channel < channels_.size(); ++channel)
      if (client.queue.wants(channel)) wanted |= std::uint32_t{1} << channel;
  wanted_ = wanted;
}

}  // namespace sslam::cli
