// SPDX-License-Identifier: BSD-3-Clause
// Input that has no end and no list: a camera, a stream in the network, a pipe.
#pragma once

#include <optional>
#include <string>

namespace sslam::cli {

enum class StreamKind {
  kDevice,  // a number, or /dev/video0
  kUrl,     // rtsp://, http:// and the like
  kPipe,    // - for standard input, or a named pipe
};

struct StreamName {
  StreamKind kind = StreamKind::kPipe;
  std::string text;  // as the user wrote it
};

// For people and files: without the password that an address may have.
[[nodiscard]] std::string shown_name(const StreamName& name);

// Nothing: `text` names no stream. A folder or a file that is called by a number is no device.
[[nodiscard]] std::optional<StreamName> stream_named(const std::string& text);

// The kinds, for messages.
inline constexpr const char* kStreamKinds =
    "a camera (0, /dev/video0), an address (rtsp://, http://) or - for standard input";

}  // namespace sslam::cli
