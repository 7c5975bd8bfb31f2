// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/stream_trouble.hpp"

extern "C" {
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>

#include "cli/input/ffmpeg_parts.hpp"
#include "sslam/core/file_kind.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::cli {
namespace {

constexpr std::array<std::string_view, 3> kSecureSchemes{"https", "rtsps", "rtmps"};

std::string code_text(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  return text;
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

// One line of it, without its end.
std::string first_line(const std::string& said) {
  return said.substr(0, said.find('\n'));
}

// What an http server sends: its type and its first bytes.
struct Answer {
  std::string type, head;
};

Answer ask_again(const std::string& url, Patience& patience) {
  Answer answer;
  const AVIOInterruptCB over{[](void* p) { return static_cast<Patience*>(p)->over() ? 1 : 0; }, &patience};
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "http,https,httpproxy,tcp,tls", 0);
  AVIOContext* io = nullptr;
  const int code = avio_open2(&io, url.c_str(), AVIO_FLAG_READ, &over, &options);
  av_dict_free(&options);
  if (code < 0) return answer;
  std::array<unsigned char, 512> bytes{};
  const int got = avio_read(io, bytes.data(), static_cast<int>(bytes.size()));
  if (got > 0) answer.head.assign(bytes.begin(), bytes.begin() + got);
  std::uint8_t* type = nullptr;
  if (av_opt_get(io, "mime_type", AV_OPT_SEARCH_CHILDREN, &type) >= 0 && type != nullptr)
    answer.type = reinterpret_cast<const char*>(type);
  av_free(type);
  avio_close(io);
  return answer;
}

std::string trouble_of_answer(const Answer& answer) {
  if (answer.head.empty()) return "answers, but sends nothing; expected a stream or a video";
  if (file_kind(answer.head) == "is a web page" || answer.type.starts_with("text/html"))
    return "is a web page; expected the address of the stream itself, which the page or the camera's manual "
           "may name";
  const bool video = answer.type.starts_with("video/") || answer.type.starts_with("image/") ||
                     answer.type.starts_with("multipart/");
  if (!answer.type.empty() && !video) return "sends '" + answer.type + "', and no video or images";
  return "broke off before its first whole image came, or sends nothing that is a video or an image";
}

std::string unknown_scheme(const std::string& url) {
  return "'" + scheme_of(url) +
         "' is no protocol that is read here; expected http, https, rtsp, rtmp, udp, rtp or srt";
}

}  // namespace

std::string scheme_of(const std::string& url) {
  const std::size_t end = url.find("://");
  return end == std::string::npos ? std::string() : io::lower_case(url.substr(0, end));
}

std::string host_of(const std::string& url) {
  const std::size_t scheme = url.find("://"), begin = scheme == std::string::npos ? 0 : scheme + 3;
  std::string host = url.substr(begin, url.find_first_of("/?#", begin) - begin);
  if (const std::size_t at = host.rfind('@'); at != std::string::npos) host.erase(0, at + 1);
  const std::size_t port = host.starts_with('[') ? host.find(']') + 1 : host.find(':');
  return host.substr(0, port);
}

std::string trouble_at_opening(int code, const std::string& url, const std::string& said,
                               Patience& patience) {
  const std::string scheme = scheme_of(url);
  if (url.empty())
    return code == AVERROR_INVALIDDATA                   ? "sends nothing that is a video or an image"
           : code == AVERROR_EOF || code == AVERROR(EIO) ? "broke off before its first whole image came"
           : code == AVERROR_EXIT                        ? "does not answer"
                                                         : "cannot be opened: " + code_text(code);
  if (host_of(url).empty())
    return "has no host; expected an address such as http://HOST:PORT/PATH or rtsp://HOST/PATH";
  if (contains(said, "not on whitelist") || code == AVERROR_PROTOCOL_NOT_FOUND) return unknown_scheme(url);
  if (const std::string_view mark = "Failed to resolve hostname "; contains(said, mark)) {
    const std::string line = first_line(said.substr(said.find(mark) + mark.size()));
    const std::size_t colon = line.rfind(": ");
    return "there is no host '" + host_of(url) + "'" +
           (colon == std::string::npos ? "" : " (" + line.substr(colon + 2) + ")") +
           "; is its name right, and is it in this network?";
  }
  switch (code) {
    case AVERROR(ECONNREFUSED):
      return "the host answers, but nothing listens at this port (Connection refused); does the stream's "
             "server run, and is the port right?";
    case AVERROR(ENETUNREACH):
    case AVERROR(EHOSTUNREACH):
      return "the host cannot be reached (" + code_text(code) + "); is it in this network?";
    case AVERROR(ETIMEDOUT):
    case AVERROR_EXIT:
      return "does not answer";
    case AVERROR(ECONNRESET):
    case AVERROR(EPIPE):
    case AVERROR_EOF:
      return "closes the connection without an answer; is it the server of a stream, and is '" + scheme +
             "' its protocol?";
    case AVERROR_HTTP_UNAUTHORIZED:
      return "needs a user name and a password, or refuses those given (401 Unauthorized); expected " +
             scheme + "://USER:PASSWORD@" + host_of(url) + "/...";
    case AVERROR_HTTP_FORBIDDEN:
      return "the server does not allow this (403 Forbidden)";
    case AVERROR_HTTP_NOT_FOUND:
      return "the server has nothing there (404 Not Found); is the path after the host right?";
    case AVERROR_HTTP_BAD_REQUEST:
    case AVERROR_HTTP_OTHER_4XX:
      return "the server refuses the request (" + code_text(code) + ")";
    case AVERROR_HTTP_SERVER_ERROR:
      return "the server has failed (" + code_text(code) + "); the camera itself may be off";
    case AVERROR(EINVAL):
      return "is no address of a stream; expected one such as http://HOST:PORT/PATH or rtsp://HOST/PATH";
    default:
      break;
  }
  if (std::find(kSecureSchemes.begin(), kSecureSchemes.end(), scheme) != kSecureSchemes.end() &&
      (contains(said, "TLS") || contains(said, "SSL") || contains(said, "handshake")))
    return "the secure connection fails (" + first_line(said) + "); does the server speak '" +
           scheme.substr(0, scheme.size() - 1) + "'?";
  const bool http = scheme == "http" || scheme == "https";
  if (http && (code == AVERROR(EIO) || code == AVERROR_INVALIDDATA))
    return trouble_of_answer(ask_again(url, patience));
  if (code == AVERROR_INVALIDDATA) return "sends nothing that is a video or an image";
  if (code == AVERROR(EIO)) return "broke off before its first whole image came";
  return "cannot be opened: " + code_text(code);
}

std::string trouble_while_reading(int code, bool over) {
  if (over) return "no more data arrived";
  if (code >= 0 || code == AVERROR_EOF) return {};
  if (code == AVERROR(EIO) || code == AVERROR(ECONNRESET) || code == AVERROR(EPIPE))
    return "the connection ended";
  return io::lower_case(code_text(code));
}

}  // namespace sslam::cli
