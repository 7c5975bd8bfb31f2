// SPDX-License-Identifier: BSD-3-Clause
// Why a stream cannot be opened, by what FFmpeg says.
#include "cli/stream/stream_trouble.hpp"

extern "C" {
#include <libavutil/error.h>
}

#include <cerrno>
#include <set>
#include <string>

#include "io/errors.hpp"
#include "support/catch.hpp"

namespace stream_trouble_test {

using namespace sslam;
using testing::contains;

namespace {

std::string trouble(int code, const std::string& url = "rtsp://camera/x", const std::string& said = {}) {
  cli::Patience patience([] { return true; });  // asks no server
  return cli::trouble_at_opening(code, url, said, patience);
}

}  // namespace

TEST_CASE("each reason why a stream cannot be opened has a line of its own") {
  std::set<std::string> lines;
  for (const int code : {AVERROR(ECONNREFUSED), AVERROR(EHOSTUNREACH), AVERROR(ETIMEDOUT), AVERROR_EOF,
                         AVERROR_HTTP_UNAUTHORIZED, AVERROR_HTTP_FORBIDDEN, AVERROR_HTTP_NOT_FOUND,
                         AVERROR_HTTP_OTHER_4XX, AVERROR_HTTP_SERVER_ERROR, AVERROR(EINVAL),
                         AVERROR_INVALIDDATA, AVERROR(EIO), AVERROR_PROTOCOL_NOT_FOUND}) {
    const std::string line = trouble(code);
    INFO(line);
    CHECK(testing::is_one_line(line));
    CHECK(lines.insert(line).second);
  }
  CHECK(contains(trouble(AVERROR(ENOMEM)), "cannot be opened: "));
}

TEST_CASE("a host that is not there, and a secure connection that fails, are told from what was said") {
  CHECK(trouble(AVERROR(EIO), "http://user:secret@nowhere:80/x",
                "Failed to resolve hostname nowhere: Name or service not known\n") ==
        "there is no host 'nowhere' (Name or service not known); is its name right, and is it in this "
        "network?");
  CHECK(
      contains(trouble(AVERROR(EIO), "https://camera/x", "An unexpected TLS packet was received.\n"),
               "the secure connection fails (An unexpected TLS packet was received.); does the server speak "
               "'http'?"));
  CHECK(contains(trouble(AVERROR(EINVAL), "ftp://camera/x", "Protocol 'ftp' not on whitelist 'http'!\n"),
                 "'ftp' is no protocol that is read here"));
  CHECK(contains(trouble(AVERROR(ECONNREFUSED), "http:///x"), "has no host"));
}

TEST_CASE("a pipe is told as a pipe") {
  CHECK(trouble(AVERROR_INVALIDDATA, "") == "sends nothing that is a video or an image");
  CHECK(trouble(AVERROR_EOF, "") == "broke off before its first whole image came");
}

TEST_CASE("the parts of an address") {
  CHECK(cli::scheme_of("RTSP://a:b@host:554/x?y=z") == "rtsp");
  CHECK(cli::host_of("RTSP://a:b@host:554/x?y=z") == "host");
  CHECK(cli::host_of("http://[::1]:80/x") == "[::1]");
  CHECK(cli::host_of("http://host") == "host");
  CHECK(cli::host_of("http://").empty());
}

TEST_CASE("why a stream that has given frames gives none any more") {
  CHECK(cli::trouble_while_reading(AVERROR_EOF, false).empty());
  CHECK(cli::trouble_while_reading(0, false).empty());
  CHECK(cli::trouble_while_reading(AVERROR(EIO), false) == "the connection ended");
  CHECK(cli::trouble_while_reading(0, true) == "no more data arrived");
}

}  // namespace stream_trouble_test
