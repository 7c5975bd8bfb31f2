// SPDX-License-Identifier: BSD-3-Clause
#include "cli/fetch/download.hpp"

#include <curl/curl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Transfer {
  std::FILE* file = nullptr;
  curl_off_t before = 0;  // bytes of an earlier try
  std::string name;
  bool quiet = false;
  Clock::time_point shown = Clock::now();
};

std::size_t take(const char* data, std::size_t size, std::size_t count, void* transfer) {
  return std::fwrite(data, size, count, static_cast<Transfer*>(transfer)->file);
}

// curl stops the transfer when this is not 0.
int show(void* context, curl_off_t total, curl_off_t now, curl_off_t, curl_off_t) {
  auto& transfer = *static_cast<Transfer*>(context);
  if (Interrupt::asked()) return 1;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto interval = terminal ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000);
  if (transfer.quiet || Clock::now() - transfer.shown < interval) return 0;
  transfer.shown = Clock::now();
  constexpr double kMegabyte = 1e6;
  std::fprintf(stderr, "%s%s  %.1f of %.1f MB%s", terminal ? "\r" : "", transfer.name.c_str(),
               static_cast<double>(transfer.before + now) / kMegabyte,
               static_cast<double>(transfer.before + total) / kMegabyte, terminal ? "\033[K" : "\n");
  return 0;
}

void set_options(CURL* curl, const std::string& address, Transfer& transfer, char* message) {
  curl_easy_setopt(curl, CURLOPT_URL, address.c_str());
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  const bool secure = address.starts_with("https:");  // and stays so
  curl_easy_setopt(curl, CURLOPT_REDIR_PROTOCOLS_STR, secure ? "https" : "http,https");
  curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(curl, CURLOPT_MAXREDIRS, 10L);
  curl_easy_setopt(curl, CURLOPT_FAILONERROR, 1L);
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, 20L);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1L);  // bytes a second, for as many seconds
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, 60L);
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, message);
  curl_easy_setopt(curl, CURLOPT_RESUME_FROM_LARGE, transfer.before);
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, take);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, &transfer);
  curl_easy_setopt(curl, CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(curl, CURLOPT_XFERINFOFUNCTION, show);
  curl_easy_setopt(curl, CURLOPT_XFERINFODATA, &transfer);
}

// One try, from the end of `part` on.
CURLcode attempt(const std::string& address, const fs::path& part, Transfer& transfer, std::string& message) {
  std::error_code none;
  const auto size = fs::file_size(part, none);
  transfer.before = none ? 0 : static_cast<curl_off_t>(size);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(part.c_str(), "ab"), std::fclose);
  if (!file) throw Error(part.string() + ": cannot write");
  transfer.file = file.get();
  const std::unique_ptr<CURL, void (*)(CURL*)> curl(curl_easy_init(), curl_easy_cleanup);
  char text[CURL_ERROR_SIZE] = "";
  set_options(curl.get(), address, transfer, text);
  CURLcode code = curl_easy_perform(curl.get());
  if (std::fflush(file.get()) != 0 && code == CURLE_OK) code = CURLE_WRITE_ERROR;
  message = text[0] != '\0' ? text : curl_easy_strerror(code);
  long answer = 0;
  curl_easy_getinfo(curl.get(), CURLINFO_RESPONSE_CODE, &answer);
  constexpr long kRangeNotSatisfiable = 416;
  return answer == kRangeNotSatisfiable ? CURLE_RANGE_ERROR : code;
}

}  // namespace

void download(const std::string& address, const fs::path& file, Verbosity verbosity) {
  const fs::path part = file.string() + ".part";
  Transfer transfer;
  transfer.name = file.filename().string();
  transfer.quiet = verbosity == Verbosity::kQuiet;
  const Interrupt interrupt;
  std::string message;
  CURLcode code = attempt(address, part, transfer, message);
  if (code == CURLE_RANGE_ERROR && transfer.before > 0) {  // this server, or that rest, cannot be resumed
    fs::remove(part);
    code = attempt(address, part, transfer, message);
  }
  if (!transfer.quiet && isatty(STDERR_FILENO) != 0) std::fputc('\n', stderr);
  if (code == CURLE_ABORTED_BY_CALLBACK) throw Stop{ExitCode::kInterrupted};
  if (code != CURLE_OK) {
    std::error_code ignored;
    const auto received = fs::file_size(part, ignored);
    if (received == 0) fs::remove(part, ignored);
    throw Error(address + ": " + message +
                (received > 0 ? "; the same command continues the download"
                              : "; check the network and the address; --mirror gives another address"));
  }
  fs::rename(part, file);
}

}  // namespace sslam::cli
