// SPDX-License-Identifier: BSD-3-Clause
// A page for browsers on this machine: served on 127.0.0.1 alone, at an address that nobody can guess.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace sslam::cli {

class ConnectionWatch;
class Interrupt;

using SharedText = std::shared_ptr<const std::string>;

// What the server answers with. Called from several threads at once.
struct ViewContent {
  std::function<SharedText()> page;
  // JSON about what is newer than the version that the page has; null: nothing. Empty: the page stays as it
  // is.
  std::function<SharedText(std::uint64_t version)> news;
};

class ViewServer {
 public:
  // port 0: any free one. Throws Error when the port cannot be had.
  ViewServer(int port, ViewContent content);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  // Of the page, with the token in it.
  [[nodiscard]] std::string address() const;

 private:
  void open_port(int port);
  void answer(const httplib::Request& request, httplib::Response& response) const;

  ViewContent content_;
  std::string token_;
  int port_ = 0;
  std::unique_ptr<httplib::Server> server_;
  std::unique_ptr<ConnectionWatch> watch_;
  std::thread thread_;
};

// Returns after Ctrl-C. Make the Interrupt before somebody is told that it can be pressed.
void wait_for(const Interrupt& interrupt);

}  // namespace sslam::cli
