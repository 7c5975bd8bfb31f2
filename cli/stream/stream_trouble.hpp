// SPDX-License-Identifier: BSD-3-Clause
// Why a stream in the network, or in a pipe (`url` empty), cannot be opened, or has ended: one line for
// people.
#pragma once

#include <string>

#include "cli/stream/patience.hpp"

namespace sslam::cli {

// `code`: FFmpeg's error. `said`: what its libraries told of it. Asks an http server once more where the code
// does not tell what it sends. The text follows the stream's name and a colon.
[[nodiscard]] std::string trouble_at_opening(int code, const std::string& url, const std::string& said,
                                             Patience& patience);

// Of a stream that has given frames: "the connection ended", or empty: it has come to its end. `over`: its
// patience is.
[[nodiscard]] std::string trouble_while_reading(int code, bool over);

// The part of an address up to its "://"; empty: none.
[[nodiscard]] std::string scheme_of(const std::string& url);
// The host, without user, password and port.
[[nodiscard]] std::string host_of(const std::string& url);

}  // namespace sslam::cli
