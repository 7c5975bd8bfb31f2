// SPDX-License-Identifier: BSD-3-Clause
#include "cli/view/view_server.hpp"

#include <httplib.h>  // what it includes defines a macro that Eigen's headers do not survive: keep them apart

#include <cerrno>
#include <chrono>
#include <cstring>

#include "cli/shell/interrupt.hpp"
#include "cli/view/access_token.hpp"
#include "cli/view/connection_watch.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kWorkers = 32;  // most of them wait for slow clients

// Without caring for copies, and as it is: compressing costs more than sending it to the same machine.
void send(httplib::Response& response, const SharedText& text, const char* type) {
  const auto provide = [text](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
    return sink.write(text->data() + offset, length);
  };
  response.set_content_provider(text->size(), type, provide);
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain");
}

// A page elsewhere whose name leads here (DNS rebinding) must not be answered.
bool addressed_to(const httplib::Request& request, int port) {
  if (request.get_header_value_count("Host") != 1) return false;
  const std::string host = request.get_header_value("Host"), end = ":" + std::to_string(port);
  return host == kHost + end || host == "localhost" + end;
}

}  // namespace

ViewServer::ViewServer(int port, ViewContent content)
    : content_(std::move(content)), token_(random_token()), server_(std::make_unique<httplib::Server>()) {
  server_->new_task_queue = [] { return new httplib::ThreadPool(kWorkers); };
  // A connection left open would keep a worker, and hold up the end.
  server_->set_keep_alive_max_count(1);
  server_->set_keep_alive_timeout(1);
  server_->set_read_timeout(2);
  server_->set_payload_max_length(0);
  server_->set_default_headers({{"Cache-Control", "no-store"},
                                {"Content-Security-Policy", "frame-ancestors 'none'"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Referrer-Policy", "no-referrer"},
                                {"X-Content-Type-Options", "nosniff"}});
  server_->set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    watch_->request_read(request.remote_port);
    answer(request, response);
    return httplib::Server::HandlerResponse::Handled;
  });
  server_->set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
        refuse(response, 500, "The page could not be made.");
      });
  open_port(port);
  watch_ = std::make_unique<ConnectionWatch>(port_);
  thread_ = std::thread([this] { server_->listen_after_bind(); });
  while (!server_->is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

ViewServer::~ViewServer() {
  server_->stop();
  watch_->end_all();  // else it would wait for whoever is connected
  thread_.join();
}

void ViewServer::open_port(int port) {
  // Nothing but this, unlike the library's own choice: a port that another program listens on is not shared.
  server_->set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  errno = 0;
  port_ = port;
  if (port == 0) port_ = server_->bind_to_any_port(kHost);
  if (port_ > 0 && (port == 0 || server_->bind_to_port(kHost, port))) return;
  const std::string number = "--port " + std::to_string(port);
  if (errno == EADDRINUSE)
    throw Error(number + ": is in use by another program; choose another, or 0 for any free one");
  throw Error(number + ": cannot be opened (" + std::strerror(errno) +
              "); choose another, or 0 for any free one");
}

std::string ViewServer::address() const {
  return std::string("http://") + kHost + ":" + std::to_string(port_) + "/" + token_ + "/";
}

void ViewServer::answer(const httplib::Request& request, httplib::Response& response) const {
  if (!addressed_to(request, port_))
    return refuse(response, 403,
                  "This server answers to 127.0.0.1:" + std::to_string(port_) +
                      " alone; forward the same port: ssh -L " + std::to_string(port_) +
                      ":127.0.0.1:" + std::to_string(port_) + " MACHINE");
  const auto slash = request.path.find('/', 1);
  if (!request.path.starts_with('/') || !same_text(request.path.substr(1, slash - 1), token_))
    return refuse(response, 403, "Use the whole address that sslam printed.");
  if (request.method != "GET") {
    response.set_header("Allow", "GET");
    return refuse(response, 405, "This server only answers GET requests.");
  }
  if (slash == std::string::npos) return response.set_redirect(request.path + "/");
  const std::string name = request.path.substr(slash + 1);
  if (name.empty()) return send(response, content_.page(), "text/html; charset=utf-8");
  if (name != "news" || !content_.news) return refuse(response, 404, "There is no such page.");
  const auto version = io::parse_number<std::uint64_t>(request.get_param_value("version"));
  const SharedText news = content_.news(version.value_or(0));
  if (news == nullptr) {
    response.status = 204;
    return;
  }
  send(response, news, "application/json");
}

void wait_for(const Interrupt& interrupt) {
  while (!interrupt.asked()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace sslam::cli
